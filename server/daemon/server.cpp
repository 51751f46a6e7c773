#include "daemon/server.h"

#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>
#include <grpc/grpc.h>
#include <grpcpp/ext/proto_server_reflection_plugin.h>
#include <grpcpp/health_check_service_interface.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "base/status_macros.h"
#include "daemon/socket.h"
#include "rpc/unreadable_requests.h"

namespace isofield::daemon {

namespace {

absl::StatusOr<std::unique_ptr<RegionSocket>> share_memory(const Config& config, rpc::SharedRegions& regions) {
  if (!config.shared_memory) return nullptr;
  const std::string path = region_socket_path(config);
  if (path.empty()) {
    return absl::InvalidArgumentError(
        absl::StrCat("--shared-memory: expected --listen unix:PATH, not --listen ", config.listen));
  }
  return RegionSocket::listen(path, regions, config.limits.shared.max_regions);
}

// Tells gRPC what to serve, at which address, and within which limits. gRPC sets `port` when the server starts.
void set_up(const Config& config, Services& services, grpc::ServerBuilder& builder, int& port) {
  builder.AddListeningPort(config.listen, grpc::InsecureServerCredentials(), &port);
  // Otherwise a second daemon could listen on the same port without an error.
  builder.AddChannelArgument(GRPC_ARG_ALLOW_REUSEPORT, 0);
  builder.SetMaxReceiveMessageSize(static_cast<int>(config.limits.max_message_bytes));
  builder.SetMaxSendMessageSize(-1);
  grpc::ResourceQuota quota("isofieldd");
  quota.SetMaxThreads(config.max_threads);
  builder.SetResourceQuota(quota);
  for (grpc::Service* service : services.all()) builder.RegisterService(service);
  std::vector<std::unique_ptr<grpc::experimental::ServerInterceptorFactoryInterface>> interceptors;
  if (services.call_log().is_on()) interceptors.push_back(services.call_log().interceptors());
  interceptors.push_back(rpc::refuse_unreadable_requests());
  builder.experimental().SetInterceptorCreators(std::move(interceptors));
}

}  // namespace

absl::StatusOr<std::unique_ptr<Server>> Server::start(const Config& config, Services& services) {
  ISOFIELD_RETURN_IF_ERROR(check_listen_address(config.listen));
  auto started = std::unique_ptr<Server>(new Server);
  ISOFIELD_ASSIGN_OR_RETURN(started->region_socket_, share_memory(config, services.shared_regions()));
  // This reference to gRPC is never given back. Whoever gives the last one back waits for gRPC's pollers, each of which
  // may sleep for 10 s after a client was slow to read.
  grpc_init();
  grpc::EnableDefaultHealthCheckService(true);
  grpc::reflection::InitProtoReflectionServerBuilderPlugin();
  grpc::ServerBuilder builder;
  int port = 0;
  set_up(config, services, builder, port);
  started->evaluate_calls_ = std::make_unique<rpc::EvaluateCalls>(services.fields(), builder.AddCompletionQueue());
  started->evaluate_streams_ = std::make_unique<rpc::EvaluateStreams>(services.fields(), builder.AddCompletionQueue());
  started->server_ = builder.BuildAndStart();
  const bool is_unix = absl::StartsWith(config.listen, "unix:");
  if (!started->server_ || (!is_unix && port <= 0)) {
    return absl::UnavailableError(absl::StrCat("cannot listen on ", config.listen,
                                               ": is the address this machine's, and free? (--listen HOST:PORT or "
                                               "unix:PATH)"));
  }
  // Clients may also ask for the health of one service by its name.
  for (const std::string& name : Services::names()) {
    started->server_->GetHealthCheckService()->SetServingStatus(name, true);
  }
  started->evaluate_calls_->start(std::max(config.max_threads / 8, 2));
  started->evaluate_streams_->start(std::max(config.max_threads / 8, 2));
  if (is_unix) {
    spdlog::info("listening on {}", config.listen);
  } else {
    spdlog::info("listening on {}:{}", config.listen.substr(0, config.listen.rfind(':')), port);
  }
  return started;
}

void Server::stop(std::chrono::seconds drain) {
  server_->GetHealthCheckService()->SetServingStatus(false);
  server_->Shutdown(std::chrono::system_clock::now() + drain);
  server_->Wait();
  evaluate_calls_->stop();
  evaluate_streams_->stop();
}

}  // namespace isofield::daemon
