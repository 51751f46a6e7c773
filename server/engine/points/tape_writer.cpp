#include "engine/points/tape_writer.h"

#include <absl/strings/str_cat.h>

#include <array>
#include <bit>
#include <vector>

#include "gpu/commands.h"

namespace isofield::engine {
namespace {

using blobtree::Instruction;
using blobtree::Operand;
using blobtree::Operator;

// A number as GLSL's uint.
template <class T>
std::string literal(T number) {
  return absl::StrCat(static_cast<std::uint32_t>(number), "u");
}

class Writer {
 public:
  std::string run(const blobtree::Tape& tape) {
    text_ = "Field evaluate_tape(vec3 p) {\n";
    for (const Instruction& i : tape.code) write(i);
    absl::StrAppend(&text_, "  return ", accumulator_, ";\n}\n");
    return std::move(text_);
  }

 private:
  void write(const Instruction& i) {
    if (i.op() == Operator::kBtk || i.op() == Operator::kSuperelliptic) return write_many(i);
    const std::string operand = right_operand(i);
    if (i.op() == Operator::kPush) {
      // The first one pushes nothing.
      if (!accumulator_.empty()) waiting_.push_back(accumulator_);
      accumulator_ = operand;
      return;
    }
    accumulator_ = define(absl::StrCat("apply_operator(", accumulator_, ", ", operand, ", ", literal(i.op()), ", ",
                                       literal(i.mode().bits()), ", ", literal(i.operation), ")"));
  }

  std::string right_operand(const Instruction& i) {
    if (i.operand() == Operand::kPop) {
      std::string popped = accumulator_;
      accumulator_ = pop();
      return popped;
    }
    if (i.operand() == Operand::kZero) return "zero_field()";
    return define(absl::StrCat("leaf_field(p, ", literal(i.operand()), ", ", literal(i.leaf), ")"));
  }

  // As operators.glsl has operands of many: the last one first, and what is beyond is of none.
  void write_many(const Instruction& i) {
    std::string operands = accumulator_;
    const int count = std::popcount(i.leaf);
    for (int k = 1; k < kMostOperands; ++k) {
      absl::StrAppend(&operands, ", ", k < count ? pop() : accumulator_);
    }
    accumulator_ =
        define(absl::StrCat("apply_to_many(Field[MAX_OPERANDS](", operands, "), ", literal(i.op()), ", ",
                            literal(i.leaf), ", ", literal(i.mode().bits()), ", ", literal(i.operation), ")"));
  }

  std::string define(const std::string& value) {
    const std::string name = absl::StrCat("v", ++names_);
    absl::StrAppend(&text_, "  Field ", name, " = ", value, ";\n");
    return name;
  }

  std::string pop() {
    std::string top = std::move(waiting_.back());
    waiting_.pop_back();
    return top;
  }

  static constexpr int kMostOperands = 16;  // MAX_OPERANDS of shaders/lib/ranged_blends.glsl

  std::string text_, accumulator_;
  std::vector<std::string> waiting_;
  int names_ = 0;
};

}  // namespace

bool is_writable(const blobtree::Tape& tape) {
  constexpr std::size_t kMost = gpu::kUniformBytes / 16;
  return !tape.code.empty() && tape.leaf_records <= kMost && tape.record_owners.size() <= kMost;
}

std::string write_definitions(const KernelKind& kind, bool with_gradient) {
  constexpr std::array kNames{"OPERAND_SET", "OPERATOR_SET", "STACK_DEPTH", "TAPE_LENGTH",
                              "ARITY",       "VOLUME_SET",   "UNIFORM_SET"};
  std::string text = with_gradient ? "#define WITH_GRADIENT\n" : "";
  const auto constants = kind.constants();
  for (std::size_t i = 0; i < constants.size(); ++i) {
    absl::StrAppend(&text, "#define ", kNames[i], " ", literal(constants[i]), "\n");
  }
  return text;
}

std::string write_tape(const blobtree::Tape& tape) {
  return Writer().run(tape);
}

}  // namespace isofield::engine
