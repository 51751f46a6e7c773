#include <absl/strings/str_cat.h>

#include <cstdio>
#include <filesystem>
#include <memory>

#include "commands/command_line.h"
#include "commands/picture.h"
#include "error_report.h"
#include "exit_codes.h"
#include "file_watch.h"
#include "output_file.h"

namespace isofield {
namespace {

absl::Status watch(const Context& context, const PictureFlags& flags) {
  if (auto status = flags.check(); !status.ok()) return status;
  const std::string& path = flags.mesh.scene;
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored) || std::filesystem::is_directory(path, ignored)) {
    return file_error(
        absl::NotFoundError(absl::StrCat(path, ": no such file; a scene of the server cannot be watched")));
  }
  auto client = context.connect();
  if (!client.ok()) return client.status();
  // The watch begins before the file is read for the first time, so that no change is missed.
  auto changes = FileWatch::create(path);
  if (!changes.ok()) return file_error(changes.status());
  end_well_when_interrupted();
  for (bool is_first = true;; is_first = false) {
    const absl::Status status = flags.draw(context, *client);
    // Without a server there is nothing to watch for; other errors may go away with the next change of the file.
    if (is_first && exit_code(status) == kNoServer) return status;
    if (!status.ok()) report_error(status, context.json);
    std::fflush(stdout);
    if (auto waited = (*changes)->wait(); !waited.ok()) return file_error(waited);
  }
}

}  // namespace

void add_watch_command(Command app, Context& context) {
  const auto flags = std::make_shared<PictureFlags>();
  Command command = app.add_subcommand(
      "watch",
      "Draw a picture of a file, and again whenever the file changes, until SIGINT (Ctrl-C) or SIGTERM. Faults of the "
      "file are printed, and the picture stays as it is. Without --view-file the model fills each picture");
  flags->add_to(command);
  command.option("SCENE").description("A file: a scene (.json, .pb), or one that can be imported, such as .swc");
  command.callback([&context, flags] { context.outcome = watch(context, *flags); });
}

}  // namespace isofield
