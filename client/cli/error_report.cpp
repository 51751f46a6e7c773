#include "error_report.h"

#include <absl/strings/match.h>

#include <cstdio>
#include <string>

#include "json_output.h"

namespace isofield {

ExitCode report_error(const absl::Status& error, bool json) {
  std::string message(error.message());
  const ExitCode code = exit_code(error);
  // The library's message does not know the options of this program.
  if (code == kNoServer && absl::EndsWith(message, "start isofieldd there")) message += " or state another --server";
  std::fprintf(stderr, "isofield: %s\n", message.c_str());
  if (json) {
    JsonObject fields;
    fields.set("code", absl::StatusCodeToString(error.code())).set("message", message).set("exit_code", int{code});
    JsonObject().set("error", fields).print();
  }
  return code;
}

}  // namespace isofield
