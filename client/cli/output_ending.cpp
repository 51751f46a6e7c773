#include "output_ending.h"

#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>
#include <absl/strings/str_join.h>

#include "exit_codes.h"

namespace isofield {
namespace {

struct Ending {
  const char* ending;
  const char* writers;
};

constexpr char kMesh[] = "`isofield mesh` writes meshes";
constexpr char kPicture[] = "`isofield render`, `isofield slice` and `isofield operator plot` draw pictures";
constexpr char kPlot[] = "`isofield slice` and `isofield operator plot` draw such pictures";
constexpr char kText[] = "`isofield eval`, `operator eval`, `ray`, `project`, `inside` and `slice` write tables";
constexpr char kArray[] = "`isofield eval`, `ray`, `project`, `inside` and `slice` write tables as NumPy arrays";
constexpr char kNobody[] = "no command writes such files";

constexpr Ending kEndings[] = {
    {".glb", kMesh},
    {".obj", kMesh},
    {".ply", kMesh},
    {".stl", kMesh},
    {".png", kPicture},
    {".svg", kPlot},
    {".pdf", kPlot},
    {".csv", kText},
    {".npy", kArray},
    {".pb", "`isofield import` writes scenes"},
    {".json", "`isofield import` writes scenes, and `ray`, `project`, `inside` and `slice` write tables as JSON"},
    {".gltf", kNobody},
    {".3mf", kNobody},
    {".off", kNobody},
    {".vtk", kNobody},
    {".fbx", kNobody},
    {".jpg", kNobody},
    {".jpeg", kNobody},
    {".gif", kNobody},
    {".tif", kNobody},
    {".tiff", kNobody},
    {".swc", kNobody},
    {".pdb", kNobody},
    {".ent", kNobody},
    {".cif", kNobody},
    {".mmcif", kNobody},
    {".xyz", kNobody},
    {".npz", kNobody},
    {".h5", kNobody},
    {".hdf5", kNobody},
    {".xlsx", kNobody},
    {".ods", kNobody},
    {".parquet", kNobody},
    {".gz", kNobody},
    {".zip", kNobody},
};

}  // namespace

absl::Status check_output_ending(const std::string& path, std::initializer_list<const char*> written) {
  for (const char* const ending : written) {
    if (absl::EndsWithIgnoreCase(path, ending)) return absl::OkStatus();
  }
  for (const auto& [ending, writers] : kEndings) {
    if (!absl::EndsWithIgnoreCase(path, ending)) continue;
    return usage_error(absl::StrCat(path, ": this command does not write ", ending, "; expected ",
                                    absl::StrJoin(written, " or "), ". ", writers));
  }
  return absl::OkStatus();
}

}  // namespace isofield
