#include "plot/operator_plot.h"

#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>
#include <absl/strings/str_format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "commands/operator_argument.h"
#include "exit_codes.h"
#include "json_output.h"
#include "operators/argument_columns.h"
#include "output_file.h"
#include "plot/opening_plot.h"

namespace isofield {
namespace {

constexpr double kRadians = std::numbers::pi / 180;
constexpr int kOpeningSamples = 1441;

struct PlotArguments {
  OperatorArgument op;
  std::string output;
  std::vector<double> thetas, alphas;  // degrees
  int size = 360;
};

// What the operator is where it blends nothing; nothing: there is no such place.
enum class Unblended { kNowhere, kMax, kMin };

v1::Form form_of(const v1::Operator& message) {
  switch (message.kind_case()) {
    case v1::Operator::kGradient:
      return message.gradient().form();
    case v1::Operator::kSampled:
      return message.sampled().form();
    case v1::Operator::kBarthe:
      return message.barthe().form();
    case v1::Operator::kBt2:
      return message.bt2().form();
    case v1::Operator::kBtk:
      return message.btk().form();
    default:
      return v1::FORM_UNSPECIFIED;
  }
}

Unblended unblended_of(const v1::Operator& message, bool is_signed) {
  switch (message.kind_case()) {
    case v1::Operator::kGradient:
    case v1::Operator::kSampled:
    case v1::Operator::kBarthe:
      break;
    case v1::Operator::kBt2:
      if (message.bt2().has_m1() || message.bt2().has_m2()) return Unblended::kNowhere;
      break;
    case v1::Operator::kBtk:
      if (message.btk().weights_size() > 0) return Unblended::kNowhere;
      break;
    default:
      return Unblended::kNowhere;
  }
  switch (form_of(message)) {
    case v1::INTERSECTION:
      return is_signed ? Unblended::kMax : Unblended::kMin;
    case v1::DIFFERENCE:
      return Unblended::kNowhere;  // its boundaries do not run from the axes to the diagonal
    default:
      return is_signed ? Unblended::kMin : Unblended::kMax;
  }
}

// The largest range that the operator states, or 1: what its plane is scaled to.
double scale_of(const v1::Operator& message) {
  double scale = 0;
  for (const double range : message.superelliptic().ranges()) scale = std::max(scale, range);
  for (const double range : message.btk().ranges()) scale = std::max(scale, range);
  scale = std::max({scale, message.bt2().r1(), message.bt2().r2()});
  if (message.has_pasko()) scale = std::max(message.pasko().a1(), message.pasko().a2());
  return scale > 0 && std::isfinite(scale) ? scale : 1;
}

// One panel for each angle; without angles one.
absl::StatusOr<OperatorPlot> sample_operator(const PlotArguments& arguments, ChosenOperator chosen, Client& client) {
  const OperatorArity arity = arity_of(chosen.message);
  const bool is_signed = arity.law == OperatorArity::Law::kSigned;
  const bool takes_angle = arity.is_steered || arity.by_angle;
  if (!takes_angle && !(arguments.thetas.empty() && arguments.alphas.empty())) {
    return usage_error(absl::StrCat(arguments.op.name, " takes no angle; expected neither --theta nor --alpha"));
  }
  if (!arity.is_steered && !arguments.thetas.empty()) {
    return usage_error(absl::StrCat(arguments.op.name, " takes --alpha, the angle between the gradients, not --theta"));
  }
  const bool by_alpha = arity.by_angle || !arguments.alphas.empty();
  std::vector<double> angles = by_alpha ? arguments.alphas : arguments.thetas;
  if (angles.empty() && takes_angle) {
    angles = by_alpha ? std::vector<double>{0, 45, 90, 135, 180} : std::vector<double>{0, 11.25, 22.5, 33.75, 45};
  }
  OperatorPlot plot;
  plot.x_name = is_signed ? "x1" : "f1";
  plot.y_name = is_signed ? "x2" : "f2";
  if (is_signed) {
    const double scale = scale_of(chosen.message);
    plot.low = -scale;
    plot.high = 2 * scale;
    plot.step = 0.1 * scale;
    plot.surface = 0;
    plot.inside_above = false;
  }
  // A cell of two pixels.
  plot.side = std::clamp(arguments.size / 2, 64, 256);
  const Unblended unblended = unblended_of(chosen.message, is_signed);
  chosen.request.add_columns(plot.x_name);
  chosen.request.add_columns(plot.y_name);
  if (takes_angle) chosen.request.add_columns(by_alpha ? "alpha" : "theta");
  for (std::size_t panel = 0; panel < std::max<std::size_t>(angles.size(), 1); ++panel) {
    std::vector<float> rows;
    for (int j = 0; j < plot.side; ++j) {
      for (int i = 0; i < plot.side; ++i) {
        const double step = (plot.high - plot.low) / (plot.side - 1);
        rows.push_back(static_cast<float>(plot.low + step * i));
        rows.push_back(static_cast<float>(plot.low + step * j));
        if (panel == 0 && unblended != Unblended::kNowhere) {
          const auto [least, most] = std::minmax(rows[rows.size() - 2], rows.back());
          plot.unblended.push_back(unblended == Unblended::kMin ? least : most);
        }
        if (takes_angle) rows.push_back(static_cast<float>(angles[panel] * kRadians));
      }
    }
    const auto results = client.evaluate_operator(chosen.request, rows);
    if (!results.ok()) return results.status();
    OperatorPlot::Panel& out = plot.panels.emplace_back();
    out.title =
        takes_angle ? absl::StrFormat("%s = %g deg", by_alpha ? "alpha" : "theta", angles[panel]) : arguments.op.name;
    for (std::size_t at = 0; at < results->values.size(); at += results->columns.size()) {
      out.g.push_back(results->values[at]);
    }
  }
  return plot;
}

absl::StatusOr<OpeningCurve> sample_opening(const std::string& name, v1::EvaluateOperatorRequest request,
                                            Client& client) {
  request.add_columns("alpha");
  std::vector<float> alphas;
  for (int i = 0; i < kOpeningSamples; ++i) {
    alphas.push_back(static_cast<float>(std::numbers::pi * i / (kOpeningSamples - 1)));
  }
  const auto results = client.evaluate_operator(request, alphas);
  if (!results.ok()) return results.status();
  OpeningCurve curve{name, {}};
  for (std::size_t at = 0; at < results->values.size(); at += results->columns.size()) {
    curve.theta.push_back(results->values[at] / kRadians);
  }
  return curve;
}

// Without parameters all presets.
absl::StatusOr<Image> plot_opening(const PlotArguments& arguments, const ChosenOperator& chosen, Client& client) {
  if (!arguments.thetas.empty() || !arguments.alphas.empty()) {
    return usage_error("an opening is drawn over all angles; expected neither --theta nor --alpha");
  }
  std::vector<OpeningCurve> curves;
  const auto add = [&](const std::string& name, const v1::EvaluateOperatorRequest& request) -> absl::Status {
    auto curve = sample_opening(name, request, client);
    if (curve.ok()) curves.push_back(*std::move(curve));
    return curve.status();
  };
  absl::Status status;
  if (!arguments.op.parameters.empty()) {
    status = add("opening", chosen.request);
  } else {
    for (const auto& [name, preset] :
         {std::pair("camel", v1::Opening::CAMEL), std::pair("organic", v1::Opening::ORGANIC),
          std::pair("contact", v1::Opening::CONTACT)}) {
      v1::EvaluateOperatorRequest request;
      request.mutable_opening()->set_preset(preset);
      status.Update(add(name, request));
    }
  }
  if (!status.ok()) return status;
  return draw(curves, arguments.size);
}

absl::Status plot(const Context& context, const PlotArguments& arguments) {
  if (!absl::EndsWithIgnoreCase(arguments.output, ".png")) {
    return usage_error(absl::StrCat(arguments.output, ": not a picture that can be written; expected .png"));
  }
  auto client = context.connect();
  if (!client.ok()) return client.status();
  const auto chosen = choose_operator(arguments.op, *client);
  if (!chosen.ok()) return chosen.status();
  absl::StatusOr<Image> image;
  if (arguments.op.is_opening()) {
    image = plot_opening(arguments, *chosen, *client);
  } else {
    const auto sampled = sample_operator(arguments, *chosen, *client);
    if (!sampled.ok()) return sampled.status();
    image = draw(*sampled, arguments.size);
  }
  if (!image.ok()) return image.status();
  auto file = OutputFile::create(arguments.output);
  if (!file.ok()) return file_error(file.status());
  absl::Status status = write_png(*image, **file);
  if (status.ok()) status = (*file)->commit();
  if (!status.ok()) return file_error(status);
  if (context.json) JsonObject().set("file", arguments.output).print();
  return absl::OkStatus();
}

}  // namespace

void add_operator_plot_command(CLI::App& app, Context& context) {
  const auto arguments = std::make_shared<PlotArguments>();
  CLI::App* command = app.add_subcommand("plot", "Draw an operator's level curves, or openings");
  arguments->op.add_to(*command);
  command->add_option("-o,--output", arguments->output, "Picture to write (.png)")->required();
  auto* thetas = command->add_option("--theta", arguments->thetas, "Opening angles in degrees, a panel each")
                     ->delimiter(',')
                     ->allow_extra_args(false)
                     ->check(CLI::Range(0.0, 45.0))
                     ->expected(1, 16);
  command->add_option("--alpha", arguments->alphas, "Instead: angles between the gradients in degrees, a panel each")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::Range(0.0, 180.0))
      ->expected(1, 16)
      ->excludes(thetas);
  command->add_option("--size", arguments->size, "Side of a panel in pixels")
      ->check(CLI::Range(64, 2048))
      ->capture_default_str();
  command->callback([&context, arguments] { context.outcome = plot(context, *arguments); });
}

}  // namespace isofield
