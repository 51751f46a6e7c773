#include "engine/points/operator_evaluator.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/status_macros.h"
#include "blobtree/tape/operation.h"
#include "engine/kernels/bindings.h"
#include "engine/residency/resident_scene.h"
#include "engine/session.h"

namespace isofield::engine {
namespace {

constexpr std::size_t kLocalSize = 64;
constexpr std::size_t kMostRows = std::size_t{gpu::kMaxGroups} * kLocalSize;  // rows of one dispatch

// The push constants of shaders/operator_eval.comp, in its order.
struct Constants {
  std::uint32_t count = 0;
  std::uint32_t operands = 0;
  std::uint32_t columns = 0;
  Steering steering = Steering::kNone;
  std::uint32_t code = 0;
  std::uint32_t record = 0;
  std::uint32_t is_opening = 0;
};

using binding::operator_eval::kArguments, binding::operator_eval::kResults;

absl::Status run(gpu::Device& device, KernelCache& kernels, VolumeCache& volumes, blobtree::Tape tape,
                 Constants constants, std::size_t result_columns, std::span<const float> arguments,
                 std::span<float> results) {
  const KernelKind kind = KernelKind::of(tape);
  constants.code = tape.code[0].code;
  constants.record = tape.code[0].operation;
  ISOFIELD_ASSIGN_OR_RETURN(const gpu::SharedPipeline kernel, kernels.get(shaders::kOperatorEval, kind));
  ISOFIELD_ASSIGN_OR_RETURN(const auto resident, ResidentScene::create(device, volumes, std::move(tape)));
  const std::size_t rows = arguments.size() / constants.columns;
  for (std::size_t first = 0; first < rows; first += kMostRows) {
    const std::size_t count = std::min(rows - first, kMostRows);
    constants.count = static_cast<std::uint32_t>(count);
    ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(device));
    ISOFIELD_ASSIGN_OR_RETURN(const gpu::Buffer in,
                              session.upload(arguments.subspan(first * constants.columns, count * constants.columns)));
    ISOFIELD_ASSIGN_OR_RETURN(const gpu::Buffer out, session.scratch(count * result_columns * sizeof(float)));
    // The kernel runs no tape, so any buffer will do in the tape's place.
    ISOFIELD_RETURN_IF_ERROR(
        session.commands().dispatch(kernel, resident->bindings(in, {{kArguments, &in}, {kResults, &out}}), constants,
                                    static_cast<std::uint32_t>((count + kLocalSize - 1) / kLocalSize)));
    ISOFIELD_RETURN_IF_ERROR(session.download(out, results.subspan(first * result_columns, count * result_columns)));
    ISOFIELD_RETURN_IF_ERROR(session.run());
  }
  return absl::OkStatus();
}

// Returns the rows of arguments as the kernel takes them. They have tan(theta) in place of theta or, for an operator
// that follows an angle, the angle's cosine and sine in place of the angle.
std::vector<float> device_rows(std::span<const float> arguments, std::size_t operands, bool by_angle) {
  const std::size_t columns = operands + (by_angle ? 2 : 1);
  std::vector<float> rows;
  rows.reserve(arguments.size() / columns * (columns + (by_angle ? 1 : 0)));
  for (std::size_t at = 0; at < arguments.size(); at += columns) {
    const float* row = &arguments[at];
    rows.insert(rows.end(), row, row + operands);
    const double angle = row[operands];
    if (by_angle) {
      rows.insert(rows.end(),
                  {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), row[operands + 1]});
    } else {
      rows.push_back(static_cast<float>(std::tan(angle)));
    }
  }
  return rows;
}

}  // namespace

absl::Status OperatorEvaluator::evaluate(const std::shared_ptr<const operators::Operator>& op, std::size_t operands,
                                         Steering steering, std::span<const float> arguments,
                                         std::span<float> results) {
  std::shared_ptr<const operators::Operator> steered = op;
  if (steering == Steering::kAlpha && op->form == operators::Form::kDifference) {
    // A difference turns its first operand inside out, which reverses its gradient, and so the opening is turned, too.
    auto turned = std::make_shared<operators::Operator>(*op);
    std::visit(
        []<class K>(K& kind) {
          if constexpr (operators::IsSteered<K>) kind.opening = kind.opening.turned();
        },
        turned->parameters);
    steered = std::move(turned);
  }
  const bool by_angle = op->has_angular_ranges();
  const auto k = static_cast<std::uint32_t>(operands);
  const std::uint32_t is_steered = steering != Steering::kNone ? 1 : 0;
  const Constants constants{.operands = k, .columns = k + is_steered + (by_angle ? 2u : 0u), .steering = steering};
  std::vector<float> rows;
  if (by_angle || steering == Steering::kTheta) {
    rows = device_rows(arguments, operands, by_angle);
    arguments = rows;
  }
  return run(device_, kernels_, volumes_, blobtree::operator_tape(steered, op->law(), k), constants, 1 + k + is_steered,
             arguments, results);
}

absl::Status OperatorEvaluator::evaluate_opening(const operators::Opening& opening, std::span<const float> alphas,
                                                 std::span<float> results) {
  const operators::Operator op(operators::Gradient{.opening = opening});
  return run(device_, kernels_, volumes_,
             blobtree::operator_tape(std::make_shared<const operators::Operator>(op), operators::Law::kPositive, 2),
             {.columns = 1, .is_opening = 1}, 2, alphas, results);
}

}  // namespace isofield::engine
