#include "plot/operator_plot.h"

#include <absl/strings/str_cat.h>
#include <absl/strings/str_format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "commands/checks.h"
#include "commands/command_line.h"
#include "commands/operator_argument.h"
#include "exit_codes.h"
#include "json_output.h"
#include "operators/argument_columns.h"
#include "output_file.h"
#include "plot/opening_plot.h"
#include "plot/plot_file.h"
#include "plot/region_outline.h"

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

// Takes the form out of an operator, which leaves the union.
v1::Form take_form(v1::Operator& message) {
  const auto* kinds = v1::Operator::descriptor()->FindOneofByName("kind");
  const auto* reflection = message.GetReflection();
  auto& kind = *reflection->MutableMessage(&message, reflection->GetOneofFieldDescriptor(message, kinds));
  const auto* field = kind.GetDescriptor()->FindFieldByName("form");
  if (!field) return v1::UNION;
  const auto form = static_cast<v1::Form>(kind.GetReflection()->GetEnumValue(kind, field));
  kind.GetReflection()->ClearField(&kind, field);
  return form;
}

// Returns true if in some places one operand alone determines the operator's value g and in others both do. The kind of
// the operator tells this; samples could tell it only to the size of a cell.
bool has_boundary(const v1::Operator& message) {
  switch (message.kind_case()) {
    case v1::Operator::kGradient:
      // A bulge of 0 blends nothing.
      return message.gradient().silhouette().kind() != v1::Silhouette::BULGE ||
             message.gradient().silhouette().k() != 0;
    case v1::Operator::kClean:
    case v1::Operator::kBarthe:
    case v1::Operator::kBernhardt:
    case v1::Operator::kFunctional:
    case v1::Operator::kSuperelliptic:
    case v1::Operator::kBt2:
    case v1::Operator::kBtk:
      return true;
    default:
      return false;
  }
}

// Returns the length to which the plot's plane is scaled: the largest range or coordinate that the operator states, or
// 1.
double scale_of(const v1::Operator& message) {
  double scale = 0;
  for (const double range : message.superelliptic().ranges()) scale = std::max(scale, range);
  for (const double range : message.btk().ranges()) scale = std::max(scale, range);
  scale = std::max({scale, message.bt2().r1(), message.bt2().r2()});
  for (const double x : message.functional().x()) scale = std::max(scale, std::abs(x));
  for (const double h : message.functional().h()) scale = std::max(scale, std::abs(h));
  if (message.has_pasko()) scale = std::max(message.pasko().a1(), message.pasko().a2());
  return scale > 0 && std::isfinite(scale) ? scale : 1;
}

// Returns the operator as the command line states it, shortened to at most `most` characters.
std::string heading_of(const OperatorArgument& op, std::size_t most) {
  std::string heading = op.name;
  for (const std::string& parameter : op.parameters) absl::StrAppend(&heading, " ", parameter);
  return heading.size() > most ? heading.substr(0, most - 3) + "..." : heading;
}

// Samples an operator for a plot. The columns are the two operands and, if the operator takes one, an angle.
struct Sampler {
  Client& client;
  std::vector<std::string> columns;

  // Evaluates the operator at points. Each row of the result begins with g and its partial derivatives by both
  // operands. `angle` is in radians, and is used only if there is a column for it. INTERNAL: the server sent fewer
  // columns.
  absl::StatusOr<OperatorValues> sample(v1::EvaluateOperatorRequest request, const std::vector<Point>& points,
                                        double angle) const {
    request.clear_columns();
    for (const std::string& column : columns) request.add_columns(column);
    OperatorValues all;
    for (std::size_t start = 0; start < points.size(); start += Client::kChunkPoints) {
      std::vector<float> rows;
      for (std::size_t i = start; i < std::min(points.size(), start + Client::kChunkPoints); ++i) {
        rows.push_back(static_cast<float>(points[i].x));
        rows.push_back(static_cast<float>(points[i].y));
        if (columns.size() > 2) rows.push_back(static_cast<float>(angle));
      }
      auto results = client.evaluate_operator(request, rows);
      if (!results.ok()) return results.status();
      if (results->columns.size() < 3) return absl::InternalError("the server sent no partials of the operator");
      all.columns = results->columns;
      all.values.insert(all.values.end(), results->values.begin(), results->values.end());
    }
    return all;
  }
};

// Finds the curve at which the blend begins: on one side of it one operand alone determines g, on the other both do.
absl::StatusOr<std::vector<Segment>> find_boundary(const OperatorPlot& plot, const v1::Operator& message,
                                                   const Sampler& sampler, double angle, int cells) {
  if (!has_boundary(message)) return std::vector<Segment>();
  // The samples are those of the union. For other forms the operands are complemented instead: sampled directly, the
  // sides of the frame, where operands are clamped, would show up as a boundary.
  v1::EvaluateOperatorRequest request;
  *request.mutable_inline_() = message;
  const v1::Form form = take_form(*request.mutable_inline_());
  v1::Operator& blend = *request.mutable_inline_();
  // The boundary does not depend on the parameters that are reset here, and is sharpest without them, because high
  // powers underflow near it.
  if (blend.has_gradient()) {
    blend.mutable_gradient()->clear_silhouette();
    blend.mutable_gradient()->clear_volume();
  } else if (blend.has_superelliptic()) {
    blend.mutable_superelliptic()->set_exponent(2);
  } else if (blend.has_btk()) {
    blend.mutable_btk()->clear_powers();
  }
  const bool turns_x = form == v1::INTERSECTION || form == v1::DIFFERENCE, turns_y = form == v1::INTERSECTION;
  // A difference reverses the gradient of its first operand.
  const bool by_alpha = sampler.columns.size() > 2 && sampler.columns[2] == "alpha";
  if (form == v1::DIFFERENCE && by_alpha) angle = std::numbers::pi - angle;
  const double whole = plot.inside_above ? 1 : 0;  // what a field and its complement add up to
  return region_outline(plot.low, plot.high, cells,
                        [&](std::vector<Point> points) -> absl::StatusOr<std::vector<char>> {
                          for (Point& p : points) p = {turns_x ? whole - p.x : p.x, turns_y ? whole - p.y : p.y};
                          const auto results = sampler.sample(request, points, angle);
                          if (!results.ok()) return results.status();
                          std::vector<char> inside;
                          for (std::size_t at = 0; at < results->values.size(); at += results->columns.size()) {
                            // Operators return exactly 0 as the partial derivative by an operand that has no effect.
                            inside.push_back(results->values[at + 1] != 0 && results->values[at + 2] != 0);
                          }
                          return inside;
                        });
}

// Samples one panel for each angle, or a single panel for an operator without an angle.
absl::StatusOr<OperatorPlot> sample_operator(const PlotArguments& arguments, const ChosenOperator& chosen,
                                             Client& client) {
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
  plot.heading = heading_of(arguments.op, 512);
  plot.x_name = is_signed ? "x1" : "f1";
  plot.y_name = is_signed ? "x2" : "f2";
  if (is_signed) {
    const double scale = scale_of(chosen.message);
    plot.low = -scale;
    plot.high = 2 * scale;
    // All operators but the super-elliptic blend yield distances; that one is 1 beyond its ranges.
    if (!chosen.message.has_superelliptic()) plot.step = 0.1 * scale;
    plot.surface = 0;
    plot.inside_above = false;
  }
  // Values are sampled every two pixels, the boundary every pixel.
  plot.side = std::clamp(arguments.size / 2, 64, 256);
  const int boundary_cells = std::clamp(arguments.size, 128, 512);
  Sampler sampler{client, {plot.x_name, plot.y_name}};
  if (takes_angle) sampler.columns.push_back(by_alpha ? "alpha" : "theta");
  std::vector<Point> points;
  const double step = (plot.high - plot.low) / (plot.side - 1);
  for (int j = 0; j < plot.side; ++j) {
    for (int i = 0; i < plot.side; ++i) points.push_back({plot.low + step * i, plot.low + step * j});
  }
  for (std::size_t panel = 0; panel < std::max<std::size_t>(angles.size(), 1); ++panel) {
    const double angle = takes_angle ? angles[panel] * kRadians : 0;
    const auto results = sampler.sample(chosen.request, points, angle);
    if (!results.ok()) return results.status();
    OperatorPlot::Panel& out = plot.panels.emplace_back();
    if (takes_angle) out.title = absl::StrFormat("%s = %g deg", by_alpha ? "alpha" : "theta", angles[panel]);
    for (std::size_t at = 0; at < results->values.size(); at += results->columns.size()) {
      out.g.push_back(results->values[at]);
    }
    auto boundary = find_boundary(plot, chosen.message, sampler, angle, boundary_cells);
    if (!boundary.ok()) return boundary.status();
    out.boundary = *std::move(boundary);
  }
  return plot;
}

absl::StatusOr<Drawing> plot_operator(const PlotArguments& arguments, const ChosenOperator& chosen, Client& client) {
  const auto sampled = sample_operator(arguments, chosen, client);
  if (!sampled.ok()) return sampled.status();
  return draw(*sampled, arguments.size);
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

// Draws the opening function that the parameters describe, or all presets if there are none.
absl::StatusOr<Drawing> plot_opening(const PlotArguments& arguments, const ChosenOperator& chosen, Client& client) {
  if (!arguments.thetas.empty() || !arguments.alphas.empty()) {
    return usage_error("an opening is drawn over all angles; expected neither --theta nor --alpha");
  }
  std::vector<OpeningCurve> curves;
  const auto add = [&](const std::string& name, const v1::EvaluateOperatorRequest& request) -> absl::Status {
    absl::StatusOr<OpeningCurve> curve = sample_opening(name, request, client);
    if (!curve.ok()) return curve.status();
    curves.push_back(*std::move(curve));
    return absl::OkStatus();
  };
  absl::Status status;
  if (!arguments.op.parameters.empty()) {
    status = add(heading_of(arguments.op, 44), chosen.request);
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
  const auto format = plot_format(arguments.output);
  if (!format) {
    return usage_error(
        absl::StrCat(arguments.output, ": not a picture that can be written; expected .png, .svg or .pdf"));
  }
  if (auto status = OutputFile::check(arguments.output); !status.ok()) return file_error(status);
  auto client = context.connect();
  if (!client.ok()) return client.status();
  const auto chosen = choose_operator(arguments.op, *client);
  if (!chosen.ok()) return chosen.status();
  const auto drawing = arguments.op.is_opening() ? plot_opening(arguments, *chosen, *client)
                                                 : plot_operator(arguments, *chosen, *client);
  if (!drawing.ok()) return drawing.status();
  auto file = OutputFile::create(arguments.output);
  if (!file.ok()) return file_error(file.status());
  absl::Status status = write_plot(*drawing, *format, **file);
  if (status.ok()) status = (*file)->commit();
  if (!status.ok()) return file_error(status);
  if (context.json) JsonObject().set("file", arguments.output).print();
  return absl::OkStatus();
}

}  // namespace

void add_operator_plot_command(Command app, Context& context) {
  const auto arguments = std::make_shared<PlotArguments>();
  Command command = app.add_subcommand("plot", "Draw an operator's level curves, or openings");
  arguments->op.add_to(command);
  command.add_option("-o,--output", arguments->output, "Picture to write (.png, .svg or .pdf)").required();
  Option thetas = command.add_option("--theta", arguments->thetas, "Opening angles in degrees, with a panel for each")
                      .delimiter(',')
                      .one_argument_each()
                      .check(within(0.0, 45.0))
                      .expected(1, 16);
  command
      .add_option("--alpha", arguments->alphas,
                  "Instead of --theta: angles between the gradients in degrees, with a panel for each")
      .delimiter(',')
      .one_argument_each()
      .check(within(0.0, 180.0))
      .expected(1, 16)
      .excludes(thetas);
  command.add_option("--size", arguments->size, "Side of a panel in pixels; in .svg and .pdf 96 are an inch")
      .check(whole(64, 2048))
      .shows_default();
  command.callback([&context, arguments] { context.outcome = plot(context, *arguments); });
}

}  // namespace isofield
