#include <absl/strings/str_cat.h>
#include <absl/strings/str_join.h>

#include <algorithm>
#include <charconv>
#include <memory>

#include "commands/command_line.h"
#include "commands/operator_argument.h"
#include "excerpt.h"
#include "exit_codes.h"
#include "json_output.h"
#include "operators/argument_columns.h"
#include "operators/argument_table.h"
#include "output_ending.h"
#include "output_file.h"

namespace isofield {
namespace {

struct EvalArguments {
  OperatorArgument op;
  std::string points, output = "-";
};

absl::StatusOr<std::vector<std::string>> columns_for(const OperatorArgument& op, const ChosenOperator& chosen,
                                                     const std::vector<std::string>& header) {
  if (!op.is_opening()) return choose_columns(chosen.message, header);
  if (std::find(header.begin(), header.end(), "alpha") != header.end()) return std::vector<std::string>{"alpha"};
  return absl::InvalidArgumentError(
      absl::StrCat("the columns are ", excerpt(absl::StrJoin(header, ", ")), "; expected alpha (radians)"));
}

// Appends the results as lines of text. Nine significant digits give a float32 back to the bit.
void append_rows(const OperatorValues& results, std::string& text) {
  const std::size_t columns = results.columns.size();
  for (std::size_t i = 0; i < results.values.size(); ++i) {
    char digits[32];
    const auto last =
        std::to_chars(digits, digits + sizeof(digits), results.values[i], std::chars_format::general, 9).ptr;
    text.append(digits, last);
    text.push_back((i + 1) % columns == 0 ? '\n' : ',');
  }
}

absl::Status evaluate(const Context& context, const EvalArguments& arguments) {
  if (arguments.output == "-" && context.json) {
    return usage_error("--json and results on the standard output do not go together; state -o FILE");
  }
  if (auto status = check_output_ending(arguments.output, {".csv"}); !status.ok()) return status;
  if (auto status = OutputFile::check(arguments.output); !status.ok()) return file_error(status);
  auto client = context.connect();
  if (!client.ok()) return client.status();
  auto chosen = choose_operator(arguments.op, *client);
  if (!chosen.ok()) return chosen.status();
  auto table = ArgumentTable::open(arguments.points);
  if (!table.ok()) return file_error(table.status());
  const auto refuse_header = [&](const absl::Status& status) {
    return file_error(absl::InvalidArgumentError(absl::StrCat((*table)->place(), ": ", status.message())));
  };
  const auto columns = columns_for(arguments.op, *chosen, (*table)->header());
  if (!columns.ok()) return refuse_header(columns.status());
  auto places = places_of(*columns, (*table)->header());
  if (!places.ok()) return refuse_header(places.status());
  for (const std::string& column : *columns) chosen->request.add_columns(column);
  (*table)->choose(*std::move(places));
  auto file = OutputFile::create(arguments.output);
  if (!file.ok()) return file_error(file.status());

  std::size_t rows = 0;
  while (true) {
    std::vector<float> numbers;
    if (auto status = (*table)->read(Client::kChunkPoints, numbers); !status.ok()) return file_error(status);
    if (numbers.empty() && rows > 0) break;
    const auto results = client->evaluate_operator(chosen->request, numbers);
    if (!results.ok()) {
      if (rows == 0) return results.status();
      absl::Status status(results.status().code(), absl::StrCat("after ", rows, " rows: ", results.status().message()));
      return status;
    }
    std::string text = rows == 0 ? absl::StrJoin(results->columns, ",") + "\n" : "";
    append_rows(*results, text);
    if (auto status = (*file)->write(text); !status.ok()) return file_error(status);
    rows += numbers.size() / columns->size();
    if (numbers.size() < Client::kChunkPoints * columns->size()) break;
  }
  if (auto status = (*file)->commit(); !status.ok()) return file_error(status);
  if (context.json) JsonObject().set("file", arguments.output).set("rows", rows).print();
  return absl::OkStatus();
}

}  // namespace

void add_operator_eval_command(Command app, Context& context) {
  const auto arguments = std::make_shared<EvalArguments>();
  Command command = app.add_subcommand("eval", "Evaluate an operator and its partial derivatives at field values");
  arguments->op.add_to(command);
  command
      .add_option(
          "--points", arguments->points,
          "Text with a header line (.csv): columns f1,f2 [and theta or alpha], or x1,x2 ... [and alpha, ratio], "
          "or alpha for an opening; angles in radians; other columns are ignored; - is the standard input")
      .required();
  command.add_option("-o,--output", arguments->output, "Text with one row per point (.csv); - is the standard output")
      .shows_default();
  command.callback([&context, arguments] { context.outcome = evaluate(context, *arguments); });
}

}  // namespace isofield
