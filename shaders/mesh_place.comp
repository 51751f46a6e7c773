// Mesher, pass 7: places every vertex at its start and finds the creases. A workgroup takes one brick. A vertex starts
// at the mean of its patch's crossings or, in bricks that may have creases, where the tangent planes at the crossings
// meet (dual contouring: Ju, Losasso, Schaefer, Warren 2002). SMOOTH is defined for the bricks that may not have
// creases, and leaves out what creases need, because on lavapipe a branch that no invocation takes costs as much as one
// that all take.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "mesh_crossings.glsl"

layout(local_size_x = INVOCATIONS) in;

layout(std430, binding = BINDING_MESH_SURFACE_CASES) readonly buffer SurfaceCases { uvec4 surface_cases[]; };
layout(std430, binding = BINDING_MESH_VERTICES) buffer Vertices { uint vertex_list[]; };  // mesh_constants.glsl
layout(std430, binding = BINDING_MESH_POSITIONS) writeonly buffer Positions { float positions[]; };
layout(std430, binding = BINDING_MESH_PLACE_KINDS) buffer Kinds { uint kinds[]; };
// The samples of the slab that starts at brick `first`.
layout(std430, binding = BINDING_MESH_PLACE_SAMPLES) readonly buffer Samples { float samples[]; };
// The bricks to place, one for each workgroup.
layout(std430, binding = BINDING_MESH_PLACE_PLACED) readonly buffer Placed { uint placed[]; };

// A patch counts as holding a crease if the mean of the squared sines between its normals and their mean exceeds this.
// This holds for creases that turn by about 25 degrees or more, and for surfaces with a radius of up to 2.5 cells.
const float CREASE_SPREAD = 0.04;
// The damping of the meeting point. It is needed because the tangent planes at the crossings do not show how a curved
// side turns between them.
const float DAMPING = 2e-3;
// The weight of a distance across the crease, in cells, beside the cosine between two normals. Of the crossings of one
// side the one furthest from the crease is taken, because the way to a crossing beside the crease leads along the
// crease and onto its other side.
const float ACROSS = 0.1;

void main() {
  uint b = placed[gl_WorkGroupID.x];
  Brick at = brick(b);
  uint end = starts[b + 1u].x;
  for (uint v = starts[b].x + gl_LocalInvocationID.x; v < end; v += gl_WorkGroupSize.x) {
    uint vertex = vertex_list[v];
    uvec3 cell = cell_in_brick(vertex_cell(vertex));
    uint state = cells_in[b * CELLS_PER_BRICK + vertex_cell(vertex)];
    uvec4 surface = surface_cases[cell_case(state)];
    uint edges = case_edges(surface, vertex_patch(vertex));
    bool is_crowded = case_patches(surface) > 1u;
    uvec3 base = at.at * BRICK_CELLS + cell;

    vec3 sum = vec3(0.0), facing = vec3(0.0);
    Planes planes = no_planes();  // about the cell's low corner
    bool on_cap = false, by_surface = false;
    for (uint left = edges; left != 0u; left &= left - 1u) {
      uint edge = uint(findLSB(left));
      uvec3 low = edge_offset(edge), high = low + axis_vector(edge >> 2u);
      Crossing c = Crossing(vec3(0.0), vec3(0.0), false);
      if (MAY_HAVE_CREASES) {
        c = crossing_of(b, cell, edge);
      } else {
        float f0 = samples[(b - first) * CORNERS_PER_BRICK + sample_place(cell + low)];
        float f1 = samples[(b - first) * CORNERS_PER_BRICK + sample_place(cell + high)];
        c.at = mix(vec3(low), vec3(high), clamp((iso - f0) / (f1 - f0), 0.0, 1.0));
      }
      sum += c.at;
      facing += c.normal;
      add_plane(planes, c.normal, dot(c.normal, c.at));
      by_surface = by_surface || c.begins_on_surface;
      on_cap = on_cap || is_cap(base + low) || is_cap(base + high);
    }
    float count = float(bitCount(edges));
    vec3 mean = sum / count;
    planes.offset -= times(planes, mean);
    vec3 move = on_cap || is_crowded || !MAY_HAVE_CREASES ? vec3(0.0) : meeting_point(planes, mean, DAMPING);
    vec3 x = clamp(mean + move, MARGIN, 1.0 - MARGIN);

    float spread = 1.0 - dot(facing, times(planes, facing)) / (count * max(dot(facing, facing), 1e-12));
    bool on_crease = MAY_HAVE_CREASES && spread > CREASE_SPREAD && !on_cap && !is_crowded;
    if (on_crease) {
      // Three crossings are chosen: the one that faces furthest from the mean, the one that faces furthest from the
      // first, and the one that faces furthest from the plane of these two.
      vec3 ahead = facing * inversesqrt(max(dot(facing, facing), 1e-12));
      vec3 axis = -ahead, second = vec3(0.0);
      uint chosen = 0u;
      for (uint n = 0u; n < 3u; ++n) {
        float best = -1e30;
        uint best_edge = 0u;
        vec3 best_normal = vec3(0.0);
        for (uint left = edges; left != 0u; left &= left - 1u) {
          uint edge = uint(findLSB(left));
          Crossing c = crossing_of(b, cell, edge);
          float score = dot(c.normal, axis);
          score = (n == 2u ? abs(score) : score) + ACROSS * abs(dot(c.at - x, ahead));
          best_edge = score > best ? edge : best_edge;
          best_normal = score > best ? c.normal : best_normal;
          best = max(score, best);
        }
        chosen |= best_edge << (4u * n);
        axis = n == 0u ? -best_normal : cross(second, best_normal);
        second = best_normal;
      }
      vertex |= VERTEX_ON_CREASE | chosen << 12u;
      atomicOr(kinds[b], HAS_CREASES);
    }
    vertex_list[v] = vertex | (on_cap ? VERTEX_ON_CAP : 0u) | (is_crowded ? VERTEX_IS_CROWDED : 0u) |
                     (by_surface ? VERTEX_BY_SURFACE : 0u);
    vec3 p = corner_position(base) + x * origin.w;
    positions[3u * v] = p.x;
    positions[3u * v + 1u] = p.y;
    positions[3u * v + 2u] = p.z;
  }
}
