#include "isofield/client.h"

#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>
#include <grpcpp/create_channel.h>
#include <grpcpp/security/credentials.h>
#include <grpcpp/support/channel_arguments.h>

#include "address.h"
#include "client_impl.h"

namespace isofield {

Client::Client(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Client::Client(Client&&) noexcept = default;
Client& Client::operator=(Client&&) noexcept = default;
Client::~Client() = default;

absl::StatusOr<Client> Client::connect(const std::string& address, const ClientOptions& options) {
  const auto target = grpc_target(address);
  if (!target.ok()) return target.status();
  if (options.attempts < 1) return absl::InvalidArgumentError("ClientOptions::attempts: expected at least 1");

  grpc::ChannelArguments arguments;
  arguments.SetMaxReceiveMessageSize(kMaxAnswerBytes);
  arguments.SetMaxSendMessageSize(-1);  // the server states its own limit
  // The daemon is near, and a proxy that the environment states for web sites would not reach it.
  arguments.SetInt(GRPC_ARG_ENABLE_HTTP_PROXY, 0);
  // gRPC waits by default for a second before it connects again, which is longer than all attempts here take.
  arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, static_cast<int>(options.backoff.count()));
  arguments.SetInt(GRPC_ARG_MIN_RECONNECT_BACKOFF_MS, static_cast<int>(options.backoff.count()));
  const auto channel = grpc::CreateCustomChannel(*target, grpc::InsecureChannelCredentials(), arguments);

  auto impl = std::make_unique<Impl>();
  impl->address = address;
  impl->options = options;
  impl->scenes = v1::SceneService::NewStub(channel);
  impl->operators = v1::OperatorService::NewStub(channel);
  impl->fields = v1::FieldService::NewStub(channel);
  impl->meshes = v1::MeshService::NewStub(channel);
  impl->surfaces = v1::SurfaceService::NewStub(channel);
  impl->infos = v1::InfoService::NewStub(channel);
  return Client(std::move(impl));
}

absl::StatusOr<v1::SceneSummary> Client::put_scene(const std::string& name, v1::Scene scene) {
  v1::PutSceneRequest request;
  request.set_name(name);
  *request.mutable_scene() = std::move(scene);
  return put_scene(request);
}

absl::StatusOr<v1::SceneSummary> Client::put_scene(const v1::PutSceneRequest& request) {
  v1::PutSceneResponse response;
  const auto status =
      impl_->call([&](grpc::ClientContext* context) { return impl_->scenes->PutScene(context, request, &response); });
  if (!status.ok()) return status;
  return std::move(*response.mutable_summary());
}

absl::StatusOr<v1::GetSceneResponse> Client::get_scene(const std::string& name) {
  v1::GetSceneRequest request;
  request.set_name(name);
  v1::GetSceneResponse response;
  const auto attempt = [&] {
    std::string bytes;
    const absl::Status status = impl_->call([&](grpc::ClientContext* context) {
      bytes.clear();
      const auto stream = impl_->scenes->GetSceneParts(context, request);
      v1::ScenePart part;
      while (stream->Read(&part)) {
        if (part.has_summary()) *response.mutable_summary() = std::move(*part.mutable_summary());
        bytes += part.data();
      }
      return stream->Finish();
    });
    if (!status.ok() || response.mutable_scene()->ParseFromString(bytes)) return status;
    return absl::InternalError(absl::StrCat("the server sent ", bytes.size(), " bytes that are no scene"));
  };
  if (const absl::Status status = impl_->retry(attempt); !status.ok()) return status;
  return response;
}

absl::StatusOr<std::vector<v1::SceneSummary>> Client::list_scenes() {
  std::vector<v1::SceneSummary> all;
  v1::ListScenesRequest request;
  v1::ListScenesResponse response;
  do {
    const auto status = impl_->retry([&] {
      return impl_->call(
          [&](grpc::ClientContext* context) { return impl_->scenes->ListScenes(context, request, &response); });
    });
    if (!status.ok()) return status;
    all.insert(all.end(), response.scenes().begin(), response.scenes().end());
    if (!all.empty()) request.set_after(all.back().name());
  } while (response.has_more() && !response.scenes().empty());
  return all;
}

absl::Status Client::delete_scene(const std::string& name) {
  v1::DeleteSceneRequest request;
  request.set_name(name);
  v1::DeleteSceneResponse response;
  return impl_->call(
      [&](grpc::ClientContext* context) { return impl_->scenes->DeleteScene(context, request, &response); });
}

absl::StatusOr<v1::SceneSummary> Client::edit_parameters(const v1::EditParametersRequest& request) {
  v1::EditParametersResponse response;
  const auto status = impl_->call(
      [&](grpc::ClientContext* context) { return impl_->scenes->EditParameters(context, request, &response); });
  if (!status.ok()) return status;
  return std::move(*response.mutable_summary());
}

absl::StatusOr<v1::GetInfoResponse> Client::info() {
  v1::GetInfoResponse response;
  const auto status = impl_->retry([&] {
    return impl_->call(
        [&](grpc::ClientContext* context) { return impl_->infos->GetInfo(context, v1::GetInfoRequest(), &response); });
  });
  if (!status.ok()) return status;
  return response;
}

std::unique_ptr<SharedMemory> Client::Impl::take_shared_memory(std::size_t bytes) {
  if (!options.shared_memory || !absl::StartsWith(address, "unix:")) return nullptr;
  if (auto kept = shared_memory.take()) return kept;
  v1::GetInfoResponse info;
  const auto status =
      call([&](grpc::ClientContext* context) { return infos->GetInfo(context, v1::GetInfoRequest(), &info); });
  if (!status.ok() || info.shared_memory_socket().empty()) return nullptr;
  auto opened = SharedMemory::open(info.shared_memory_socket(), bytes);
  return opened.ok() ? *std::move(opened) : nullptr;
}

v1::SceneRef scene_by_name(const std::string& name) {
  v1::SceneRef reference;
  reference.set_name(name);
  return reference;
}

v1::SceneRef inline_scene(v1::Scene scene) {
  v1::SceneRef reference;
  *reference.mutable_inline_() = std::move(scene);
  return reference;
}

}  // namespace isofield
