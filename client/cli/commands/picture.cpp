#include "commands/picture.h"

#include <absl/strings/match.h>
#include <absl/strings/numbers.h>
#include <absl/strings/str_cat.h>
#include <absl/strings/str_format.h>

#include <chrono>

#include "exit_codes.h"
#include "json_output.h"
#include "mesh_files/crease_normals.h"
#include "output_file.h"

namespace isofield {
namespace {

absl::Status parse_size(const std::string& text, RenderOptions& options) {
  const std::size_t cross = text.find_first_of("xX");
  if (cross == std::string::npos || !absl::SimpleAtoi(text.substr(0, cross), &options.width) ||
      !absl::SimpleAtoi(text.substr(cross + 1), &options.height) || options.width < 16 || options.width > 8192 ||
      options.height < 16 || options.height > 8192) {
    return usage_error(absl::StrCat("--size \"", text, "\": expected WIDTHxHEIGHT, each within [16, 8192]"));
  }
  return absl::OkStatus();
}

}  // namespace

void PictureFlags::add_to(Command command) {
  mesh.crease_normals = true;
  mesh.add_to(command);
  command.add_option("-o,--output", output, "Picture to write (.png)").required();
  command.add_option("--size", size, "WIDTHxHEIGHT of the picture in pixels, each within [16, 8192]").shows_default();
  view.add_to(command);
}

absl::Status PictureFlags::check() const {
  if (!absl::EndsWithIgnoreCase(output, ".png")) {
    return usage_error(absl::StrCat(output, ": not a picture that can be written; expected .png"));
  }
  RenderOptions options;
  if (auto status = parse_size(size, options); !status.ok()) return status;
  if (auto read = view.view(); !read.ok()) return read.status();
  const absl::Status status = OutputFile::check(output);
  return status.ok() ? status : file_error(status);
}

absl::Status PictureFlags::draw(const Context& context, Client& client) const {
  RenderOptions options;
  if (auto status = parse_size(size, options); !status.ok()) return status;
  auto from = view.view();
  if (!from.ok()) return from.status();
  double seconds = 0;
  const auto surface = mesh.request(context, client, seconds);
  if (!surface.ok()) return surface.status();
  const auto start = std::chrono::steady_clock::now();
  options.view = fit_view(*surface, *from, options);
  const auto image = render(split_at_creases(*surface), options);
  if (!image.ok()) return image.status();
  auto file = OutputFile::create(output);
  if (!file.ok()) return file_error(file.status());
  absl::Status status = write_png(*image, **file);
  if (status.ok()) status = (*file)->commit();
  if (!status.ok()) return file_error(status);
  const double render_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  // The view of an empty surface has no target, so it is not kept.
  if (options.view.target) status = view.keep(options.view);
  if (!status.ok()) return status;
  const std::vector<std::string> warnings = mesh_warnings(surface->summary, mesh.cells_by());
  if (context.json) {
    JsonObject()
        .set("file", output)
        .set("request_seconds", seconds)
        .set("render_seconds", render_seconds)
        .set("summary", surface->summary)
        .set("warnings", warnings)
        .print();
  } else {
    absl::PrintF("%s: %s%u triangles, cell %g; server %.3f s, request %.3f s, rendering %.3f s\n", output,
                 shells_clause(surface->summary), surface->triangle_count(), surface->summary.cell_size(),
                 surface->summary.seconds(), seconds, render_seconds);
    print_warnings(warnings);
  }
  return absl::OkStatus();
}

}  // namespace isofield
