#pragma once

#include <absl/status/status.h>
#include <absl/status/statusor.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "isofield/mesh.h"
#include "isofield/tracked_mesh.h"
#include "isofield/v1/info_service.pb.h"
#include "isofield/v1/mesh_service.pb.h"
#include "isofield/v1/operator_service.pb.h"
#include "isofield/v1/scene.pb.h"
#include "isofield/v1/scene_service.pb.h"
#include "isofield/v1/surface_service.pb.h"

namespace isofield {

struct ClientOptions {
  // Of requests that are answered by one message; none: wait for as long as it takes.
  std::optional<std::chrono::milliseconds> unary_timeout = std::chrono::seconds(60);
  // Of streams: large evaluations, grids and meshes.
  std::optional<std::chrono::milliseconds> stream_timeout;
  // How often a request that only reads is tried while the server is UNAVAILABLE; writes are tried once. And how often
  // a request of one message is sent to a server that is busy, and says after what time to come back. >= 1.
  int attempts = 3;
  // Before the second attempt; doubled before each further one.
  std::chrono::milliseconds backoff = std::chrono::milliseconds(100);
  // Points and results of streamed evaluations go through memory shared with the server instead of the wire, where the
  // server offers that: isofieldd --shared-memory, on a unix socket, run by the same user. Elsewhere it changes
  // nothing.
  bool shared_memory = false;
};

// Samples of a field on a grid.
struct Grid {
  // Points along x, y, z.
  std::array<std::uint64_t, 3> counts;
  // [counts[2], counts[1], counts[0], 1 or 4]: x varies fastest; value, or value and gradient.
  std::vector<float> values;
};

// An operator at rows of field values.
struct OperatorValues {
  // "g" and its partial derivatives, or "theta" and "dtheta_dalpha".
  std::vector<std::string> columns;
  // [n, columns].
  std::vector<float> values;
};

// Where rays meet a surface: a row a ray. surface_service.proto, CastRaysResponse, says what the numbers are.
struct RayHits {
  // [n, 1]: infinite where nothing is hit.
  std::vector<float> distances;
  // [n, 3] each.
  std::vector<float> positions;
  std::vector<float> normals;
  // [n, 1]: places in `names`; kNothing where nothing is hit.
  std::vector<std::uint32_t> nodes;
  // [n, 1]: 1 where the ray starts inside.
  std::vector<std::uint8_t> inside;
  std::vector<std::string> names;
  // Model units; the cell size taken.
  double cell_size = 0;

  static constexpr std::uint32_t kNothing = ~0u;
};

// Points on a surface: a row a point. surface_service.proto, ProjectPointsResponse.
struct Projections {
  // [n, 3] each.
  std::vector<float> positions;
  std::vector<float> normals;
  // [n, 1] each.
  std::vector<std::uint8_t> converged;
  std::vector<float> residuals;
};

// Polylines where a field has a value.
struct LevelCurves {
  double level = 0;
  // [m, 2]: model units along the plane's axes.
  std::vector<float> points;
  // [k + 1]: the first point of each line, and m.
  std::vector<std::uint32_t> starts;
};

// The field on a part of a plane.
struct Slice {
  // Points along u and v.
  std::array<std::uint64_t, 2> counts;
  // [counts[1], counts[0]].
  std::vector<float> values;
  // One for each level asked for; of none, that of the surface.
  std::vector<LevelCurves> curves;
  // The axes that are used, as unit vectors; the first sample, and the samples' distances along u and v, in model
  // units.
  std::array<double, 3> u{}, v{}, origin{};
  std::array<double, 2> spacing{};
};

// A connection to one isofieldd. Owns its channel; every method may be called from any number of threads at once.
//
// All errors are statuses whose message says what to do. UNAVAILABLE: no server answers, or it went away.
// DEADLINE_EXCEEDED: see ClientOptions. CANCELLED: a callback asked for it. INTERNAL: the server's answer is malformed.
// Anything else is the server's own word, as the .proto files state it.
class Client {
 public:
  // Points of one chunk of a streamed evaluation: 768 KiB of coordinates, 1 MiB of values with gradients.
  static constexpr std::size_t kChunkPoints = 65536;
  // Up to this many points are evaluated by one message.
  static constexpr std::size_t kUnaryPoints = 16384;

  // Addresses: "HOST:PORT", "[IPV6]:PORT" or "unix:PATH". Connects when the first request is made.
  // INVALID_ARGUMENT: not an address.
  static absl::StatusOr<Client> connect(const std::string& address, const ClientOptions& options = {});
  Client(Client&&) noexcept;
  Client& operator=(Client&&) noexcept;
  ~Client();

  // Stores a scene, replacing one of that name. The second form may state a condition (scene_service.proto).
  absl::StatusOr<v1::SceneSummary> put_scene(const std::string& name, v1::Scene scene);
  absl::StatusOr<v1::SceneSummary> put_scene(const v1::PutSceneRequest& request);
  // Takes scenes of any size, since they are received in parts.
  absl::StatusOr<v1::GetSceneResponse> get_scene(const std::string& name);
  // By name.
  absl::StatusOr<std::vector<v1::SceneSummary>> list_scenes();
  absl::Status delete_scene(const std::string& name);
  // All edits are applied, or none.
  absl::StatusOr<v1::SceneSummary> edit_parameters(const v1::EditParametersRequest& request);
  absl::StatusOr<v1::GetInfoResponse> info();

  // Stores a custom operator, replacing one of that name. Scenes keep the one that they were put with.
  absl::StatusOr<v1::OperatorSummary> put_operator(const std::string& name, v1::Operator message);
  absl::StatusOr<v1::GetOperatorResponse> get_operator(const std::string& name);
  // The built-in ones, then the custom ones by name.
  absl::StatusOr<std::vector<v1::OperatorSummary>> list_operators();
  absl::Status delete_operator(const std::string& name);
  // An operator, or an opening, and its derivatives. `request` states it and the columns; arguments: [n, columns].
  // Large arrays travel in several messages. INVALID_ARGUMENT: arguments is no multiple of the columns.
  absl::StatusOr<OperatorValues> evaluate_operator(v1::EvaluateOperatorRequest request,
                                                   std::span<const float> arguments);
  // The opening angle that a point of the surface of a node's first child asks for; in the node's own frame.
  absl::StatusOr<v1::PickOpeningResponse> pick_opening(const v1::SceneRef& scene, const std::string& node,
                                                       const std::array<double, 3>& point);

  // The field at points. xyz: [n, 3] in model units, finite. Returns [n, 1], or with the gradient [n, 4]. Small
  // batches travel in one message, larger ones are streamed.
  // INVALID_ARGUMENT: xyz is no multiple of 3, or a coordinate is not finite.
  absl::StatusOr<std::vector<float>> evaluate(const v1::SceneRef& scene, std::span<const float> xyz, bool gradient);
  // The same to where the caller wants it: `results` holds n numbers, or with the gradient 4 n, else INVALID_ARGUMENT.
  // After an error they are undefined. For many batches one array will do: a million points take 2 ms less.
  absl::Status evaluate(const v1::SceneRef& scene, std::span<const float> xyz, bool gradient, std::span<float> results);

  // Fills an empty vector with the [n, 3] coordinates of the next chunk, 0 <= n <= kChunkPoints; n = 0 ends the
  // stream. Called on a thread of the client's own, while results are read. An error ends the evaluation with it.
  using PointSource = std::function<absl::Status(std::vector<float>& xyz)>;
  // Takes a chunk's coordinates and results ([n, 1] or [n, 4]) in the order sent, on the caller's thread. Where the
  // server answers a chunk in parts, there is a call for each part. An error ends the evaluation, which returns it.
  using ResultSink = std::function<absl::Status(std::span<const float> xyz, std::span<const float> results)>;
  // Evaluates any number of points with bounded memory: reading and writing overlap. Not retried.
  absl::Status evaluate(const v1::SceneRef& scene, bool gradient, const PointSource& source, const ResultSink& sink);

  // The field at origin + (i, j, k) * spacing; model units.
  absl::StatusOr<Grid> evaluate_grid(const v1::SceneRef& scene, const std::array<double, 3>& origin,
                                     const std::array<double, 3>& spacing, const std::array<std::uint64_t, 3>& counts,
                                     bool gradient);

  // Called on the caller's thread with the part of the work that is done and the present stage; false cancels the mesh.
  using Progress = std::function<bool(const v1::MeshProgress& progress)>;
  absl::StatusOr<Mesh> mesh(const v1::MeshRequest& request, const Progress& progress = {});
  // That mesh, or a part of it, by bricks: parts, of several servers if need be, join to the bytes of the whole.
  absl::StatusOr<MeshedBricks> mesh_bricks(const v1::MeshBricksRequest& request, const Progress& progress = {});
  // Keeps that mesh up to date while its scene, which the request names, is edited. Returns with the whole mesh.
  // ClientOptions::stream_timeout does not limit it: see TrackedMesh::cancel.
  absl::StatusOr<TrackedMesh> track_mesh(const v1::MeshRequest& request);
  // Area, volume, centroid and bounds of that mesh, which stays with the server. Takes as long as a stream may.
  absl::StatusOr<v1::MeasureResponse> measure(const v1::MeshRequest& request);

  // Questions about the surface; `request` states all but the rays or points, which are [n, 3] each. Large batches
  // travel in several messages. INVALID_ARGUMENT: the numbers are no multiple of 3, or not as many.
  absl::StatusOr<RayHits> cast_rays(v1::CastRaysRequest request, std::span<const float> origins,
                                    std::span<const float> directions);
  absl::StatusOr<Projections> project(v1::ProjectPointsRequest request, std::span<const float> xyz);
  // [n]: 1 inside, else 0.
  absl::StatusOr<std::vector<std::uint8_t>> contains(v1::ContainsRequest request, std::span<const float> xyz);
  absl::StatusOr<Slice> slice(v1::SliceRequest request);

 private:
  struct Impl;
  explicit Client(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

// A reference to a scene of the server's catalog, and to one that travels with the request.
v1::SceneRef scene_by_name(const std::string& name);
v1::SceneRef inline_scene(v1::Scene scene);

}  // namespace isofield
