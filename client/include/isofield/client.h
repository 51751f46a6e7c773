// The C++ client of isofield: a connection to one daemon (isofieldd), with a method for each of its requests. The
// .proto files in proto/isofield/v1 describe the requests, the answers and the errors in full.
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

// The settings of a Client, which hold for all of its requests.
struct ClientOptions {
  // The longest time that a request with one answer may take; get_scene() counts as one. Without a value the client
  // waits for as long as it takes.
  std::optional<std::chrono::milliseconds> unary_timeout = std::chrono::seconds(60);
  // The longest time that a stream may take: a large evaluation, a grid or a mesh. Without a value there is no limit.
  std::optional<std::chrono::milliseconds> stream_timeout;
  // How many times the client tries a request that only reads while the server is UNAVAILABLE; it tries a request that
  // writes once. The same number limits how many times it sends a request with one answer to a busy server that says
  // when to come back. At least 1.
  int attempts = 3;
  // The pause before the second attempt while the server is UNAVAILABLE. It doubles before each further attempt.
  std::chrono::milliseconds backoff = std::chrono::milliseconds(100);
  // If true, the points and results of streamed evaluations go through memory that the client shares with the server,
  // instead of the connection. The server must offer this (isofieldd --shared-memory), be reached by a unix socket, and
  // run as the same user. Elsewhere the option changes nothing.
  bool shared_memory = false;
};

// The samples of a field on a regular grid.
struct Grid {
  // The number of points along x, y and z.
  std::array<std::uint64_t, 3> counts;
  // Shape [counts[2], counts[1], counts[0], 1 or 4], x fastest: the value, or the value and the gradient, of each
  // point.
  std::vector<float> values;
};

// The values of an operator or an opening function, with its derivatives: one row for each row of arguments.
struct OperatorValues {
  // The names of the columns: "g" and its partial derivatives, or "theta" and "dtheta_dalpha" for an opening function.
  std::vector<std::string> columns;
  // Shape [n, columns].
  std::vector<float> values;
};

// The points where rays meet a surface, one row for each ray. CastRaysResponse in surface_service.proto describes the
// numbers.
struct RayHits {
  // Shape [n, 1], model units; infinite where the ray hits nothing.
  std::vector<float> distances;
  // Shape [n, 3] each: positions in model units, and unit normals that point outward; 0, 0, 0 where the ray hits
  // nothing.
  std::vector<float> positions;
  std::vector<float> normals;
  // Shape [n, 1]: the index in `names` of the primitive that the ray hits; kNothing where it hits nothing.
  std::vector<std::uint32_t> nodes;
  // Shape [n, 1]: 1 where the ray starts inside the surface, else 0.
  std::vector<std::uint8_t> inside;
  // The names of the primitives that are hit; "#i" stands for nodes[i] of the scene where that has no name.
  std::vector<std::string> names;
  // The cell size that the server used, in model units.
  double cell_size = 0;

  // This value stands in `nodes` for a ray that hits nothing.
  static constexpr std::uint32_t kNothing = ~0u;
};

// Points that were moved to a surface, one row for each point. ProjectPointsResponse in surface_service.proto describes
// the numbers.
struct Projections {
  // Shape [n, 3] each: positions in model units, and unit normals that point outward.
  std::vector<float> positions;
  std::vector<float> normals;
  // Shape [n, 1] each: 1 or 0, and the distance that is left to the surface, to first order, in model units.
  std::vector<std::uint8_t> converged;
  std::vector<float> residuals;
};

// The polylines on which the field of a Slice has one value, `level`.
struct LevelCurves {
  double level = 0;
  // Shape [m, 2]: coordinates along the u and v axes of the slice from its origin, in model units.
  std::vector<float> points;
  // Shape [k + 1]: the index of the first point of each of the k lines, and m.
  std::vector<std::uint32_t> starts;
};

// The samples of a field on a part of a plane, at origin + i spacing[0] u + j spacing[1] v, with its level curves.
struct Slice {
  // The number of samples along u and v.
  std::array<std::uint64_t, 2> counts;
  // Shape [counts[1], counts[0]], u fastest.
  std::vector<float> values;
  // One entry for each level that the request states, in its order; one for the surface if it states none.
  std::vector<LevelCurves> curves;
  // The axes as unit vectors, and the first sample in model units.
  std::array<double, 3> u{}, v{}, origin{};
  // The distances between samples along u and v, in model units.
  std::array<double, 2> spacing{};
};

// A connection to one isofieldd, which this object owns. Any number of threads may call any of its methods at the same
// time.
//
// A method that fails returns a status whose message says what is wrong and what to do. UNAVAILABLE: no server answers,
// or the connection was lost. DEADLINE_EXCEEDED: the request took longer than ClientOptions allows. CANCELLED: a
// callback asked for it. INTERNAL: the answer of the server is malformed. UNIMPLEMENTED: the server does not know the
// request. Other errors come from the server, as the .proto files state them.
class Client {
 public:
  // The most points in one chunk of a streamed evaluation: 768 KiB of coordinates, or 1 MiB of values with gradients.
  static constexpr std::size_t kChunkPoints = 65536;
  // Batches of up to this many points travel in one message; larger ones are streamed.
  static constexpr std::size_t kUnaryPoints = 16384;

  // Makes a client of the server at `address`, which is "HOST:PORT", "[IPV6]:PORT" or "unix:PATH". It connects when it
  // sends its first request. INVALID_ARGUMENT: `address` is none of these, or ClientOptions::attempts is below 1.
  static absl::StatusOr<Client> connect(const std::string& address, const ClientOptions& options = {});
  Client(Client&&) noexcept;
  Client& operator=(Client&&) noexcept;
  ~Client();

  // Stores a scene, in place of a stored scene that has the same name. The second form may state a condition for this
  // (scene_service.proto).
  absl::StatusOr<v1::SceneSummary> put_scene(const std::string& name, v1::Scene scene);
  absl::StatusOr<v1::SceneSummary> put_scene(const v1::PutSceneRequest& request);
  // Returns a stored scene of any size, which travels in parts.
  absl::StatusOr<v1::GetSceneResponse> get_scene(const std::string& name);
  // Lists the stored scenes in the order of their names.
  absl::StatusOr<std::vector<v1::SceneSummary>> list_scenes();
  absl::Status delete_scene(const std::string& name);
  // Changes numbers in a stored scene. The server applies all of the edits or none.
  absl::StatusOr<v1::SceneSummary> edit_parameters(const v1::EditParametersRequest& request);
  // Returns the version, device and limits of the server, and what it holds at present.
  absl::StatusOr<v1::GetInfoResponse> info();

  // Stores a custom operator, in place of a custom operator that has the same name. Scenes keep the operator that they
  // were stored with.
  absl::StatusOr<v1::OperatorSummary> put_operator(const std::string& name, v1::Operator message);
  absl::StatusOr<v1::GetOperatorResponse> get_operator(const std::string& name);
  // Lists the built-in operators, then the custom ones in the order of their names.
  absl::StatusOr<std::vector<v1::OperatorSummary>> list_operators();
  absl::Status delete_operator(const std::string& name);
  // Evaluates an operator or an opening function, with its derivatives. `request` states it and the columns;
  // `arguments` has the shape [n, columns]. Large arrays travel in several messages. INVALID_ARGUMENT: the length of
  // `arguments` is not a multiple of the number of columns.
  absl::StatusOr<OperatorValues> evaluate_operator(v1::EvaluateOperatorRequest request,
                                                   std::span<const float> arguments);
  // Returns the opening angle at which the blend of the two children of `node` would begin at `point`. The point lies
  // on the surface of the first child, in the frame of the node: transforms above the node are not applied.
  absl::StatusOr<v1::PickOpeningResponse> pick_opening(const v1::SceneRef& scene, const std::string& node,
                                                       const std::array<double, 3>& point);

  // Evaluates the field at points. `xyz` has the shape [n, 3], in model units, and must be finite. The result has the
  // shape [n, 1], or [n, 4] with the gradient. Small batches travel in one message; larger ones are streamed.
  // INVALID_ARGUMENT: the length of `xyz` is not a multiple of 3, or a coordinate is not finite.
  absl::StatusOr<std::vector<float>> evaluate(const v1::SceneRef& scene, std::span<const float> xyz, bool gradient);
  // Does the same, but writes to an array of the caller, which may be reused for many batches. `results` must hold n
  // numbers, or 4 n with the gradient; else the error is INVALID_ARGUMENT. After an error its contents are undefined.
  absl::Status evaluate(const v1::SceneRef& scene, std::span<const float> xyz, bool gradient, std::span<float> results);

  // A function that fills an empty vector with the coordinates of the next chunk, shape [n, 3], 0 <= n <= kChunkPoints;
  // n = 0 ends the stream. The client calls it on a thread of its own while it reads results. If the function returns
  // an error, the evaluation ends with that error.
  using PointSource = std::function<absl::Status(std::vector<float>& xyz)>;
  // A function that takes the coordinates and the results ([n, 1] or [n, 4]) of a chunk. The client calls it on the
  // thread of the caller, in the order in which the chunks were sent, and more than once for a chunk that the server
  // answers in parts. If the function returns an error, the evaluation ends with that error.
  using ResultSink = std::function<absl::Status(std::span<const float> xyz, std::span<const float> results)>;
  // Evaluates any number of points. It reads results while it sends points, and the memory that it needs is bounded.
  // The client tries this request only once.
  absl::Status evaluate(const v1::SceneRef& scene, bool gradient, const PointSource& source, const ResultSink& sink);

  // Evaluates the field at origin + (i, j, k) * spacing, in model units, for 0 <= i < counts[0] and so on.
  absl::StatusOr<Grid> evaluate_grid(const v1::SceneRef& scene, const std::array<double, 3>& origin,
                                     const std::array<double, 3>& spacing, const std::array<std::uint64_t, 3>& counts,
                                     bool gradient);

  // A function that takes the fraction of the work that is done and the present stage. The client calls it on the
  // thread of the caller; if it returns false, the client cancels the mesh and returns CANCELLED.
  using Progress = std::function<bool(const v1::MeshProgress& progress)>;
  // Meshes the surface of a scene.
  absl::StatusOr<Mesh> mesh(const v1::MeshRequest& request, const Progress& progress = {});
  // Returns the same mesh, or a part of it, as the bricks of its lattice. Parts, which may come from several servers,
  // join to the same bytes as the whole mesh.
  absl::StatusOr<MeshedBricks> mesh_bricks(const v1::MeshBricksRequest& request, const Progress& progress = {});
  // Keeps the mesh up to date while its scene, which the request names, is edited. Returns when the whole mesh has
  // come. ClientOptions::stream_timeout does not limit the stream; TrackedMesh::cancel() ends it.
  absl::StatusOr<TrackedMesh> track_mesh(const v1::MeshRequest& request);
  // Returns the area, volume, centroid and bounds of the mesh, which stays with the server.
  // ClientOptions::stream_timeout limits this request, too.
  absl::StatusOr<v1::MeasureResponse> measure(const v1::MeshRequest& request);

  // These methods ask about the surface of a scene. `request` states everything except the rays or points, which have
  // the shape [n, 3] each. Large batches travel in several messages. INVALID_ARGUMENT: a length is not a multiple of 3,
  // or there are not as many directions as origins.
  //
  // Returns where each ray first meets the surface.
  absl::StatusOr<RayHits> cast_rays(v1::CastRaysRequest request, std::span<const float> origins,
                                    std::span<const float> directions);
  // Returns the point of the surface to which the gradient leads from each point; this is not always the nearest one.
  absl::StatusOr<Projections> project(v1::ProjectPointsRequest request, std::span<const float> xyz);
  // Returns n numbers: 1 where the point is inside the surface, else 0.
  absl::StatusOr<std::vector<std::uint8_t>> contains(v1::ContainsRequest request, std::span<const float> xyz);
  // Samples the field on a part of a plane and finds its level curves.
  absl::StatusOr<Slice> slice(v1::SliceRequest request);

 private:
  struct Impl;
  explicit Client(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

// These make a reference to a scene: to one in the catalog of the server, by its name, or to one that travels with the
// request.
v1::SceneRef scene_by_name(const std::string& name);
v1::SceneRef inline_scene(v1::Scene scene);

}  // namespace isofield
