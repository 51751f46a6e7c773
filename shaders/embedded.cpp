#include "embedded.h"

namespace isofield::shaders {
namespace {

#include "grid_gradient.inc"
#include "grid_value.inc"
#include "mesh_classify.inc"
#include "mesh_connect.inc"
#include "mesh_creases_narrow.inc"
#include "mesh_creases_wide.inc"
#include "mesh_crossings_narrow.inc"
#include "mesh_crossings_wide.inc"
#include "mesh_list.inc"
#include "mesh_near.inc"
#include "mesh_normals_narrow.inc"
#include "mesh_normals_wide.inc"
#include "mesh_place_narrow.inc"
#include "mesh_place_smooth_narrow.inc"
#include "mesh_place_smooth_wide.inc"
#include "mesh_place_wide.inc"
#include "mesh_quads.inc"
#include "mesh_quads_smooth.inc"
#include "mesh_sample.inc"
#include "mesh_settle.inc"
#include "mesh_share.inc"
#include "mesh_triangles.inc"
#include "mesh_vertices_narrow.inc"
#include "mesh_vertices_wide.inc"
#include "operator_blend_probe.inc"
#include "operator_eval.inc"
#include "operator_first_probe.inc"
#include "operator_volume_probe.inc"
#include "points_gradient.inc"
#include "points_value.inc"
#include "sampled_volume.inc"
#include "smooth_volume_high.inc"
#include "smooth_volume_low.inc"
#include "sorted_points_gradient.inc"
#include "sorted_points_value.inc"
#include "table_volume_high.inc"
#include "table_volume_low.inc"

}  // namespace

const Spirv kPointsValue{points_value};
const Spirv kPointsGradient{points_gradient};
const Spirv kSortedPointsValue{sorted_points_value};
const Spirv kSortedPointsGradient{sorted_points_gradient};
const Spirv kGridValue{grid_value};
const Spirv kGridGradient{grid_gradient};
const Spirv kMeshSample{mesh_sample};
const Spirv kMeshShare{mesh_share};
const Spirv kMeshClassify{mesh_classify};
const Spirv kMeshNear{mesh_near};
const Spirv kMeshSettle{mesh_settle};
const Spirv kMeshConnect{mesh_connect};
const Spirv kMeshList{mesh_list};
const InRounds kMeshCrossings{mesh_crossings_wide, mesh_crossings_narrow};
const InRounds kMeshPlace{mesh_place_wide, mesh_place_narrow};
const InRounds kMeshPlaceSmooth{mesh_place_smooth_wide, mesh_place_smooth_narrow};
const InRounds kMeshCreases{mesh_creases_wide, mesh_creases_narrow};
const InRounds kMeshVertices{mesh_vertices_wide, mesh_vertices_narrow};
const Spirv kMeshQuads{mesh_quads};
const Spirv kMeshQuadsSmooth{mesh_quads_smooth};
const InRounds kMeshNormals{mesh_normals_wide, mesh_normals_narrow};
const Spirv kMeshTriangles{mesh_triangles};
const Spirv kOperatorEval{operator_eval};
const Spirv kOperatorBlendProbe{operator_blend_probe};
const Spirv kOperatorFirstProbe{operator_first_probe};
const Spirv kOperatorVolumeProbe{operator_volume_probe};
const Spirv kSampledVolume{sampled_volume};
const Spirv kSmoothVolumeHigh{smooth_volume_high};
const Spirv kSmoothVolumeLow{smooth_volume_low};
const Spirv kTableVolumeHigh{table_volume_high};
const Spirv kTableVolumeLow{table_volume_low};

}  // namespace isofield::shaders
