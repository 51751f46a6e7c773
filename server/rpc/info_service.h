// Implements InfoService of the contract: GetInfo describes the server, its device, its limits and what is resident.
#pragma once

#include <chrono>
#include <string>

#include "base/guarded.h"
#include "catalog/operator_catalog.h"
#include "engine/engine.h"
#include "isofield/v1/info_service.grpc.pb.h"
#include "rpc/handler.h"
#include "rpc/limits.h"
#include "scenes/resident_scenes.h"

namespace isofield::rpc {

// Thread-safe.
class InfoService final : public v1::InfoService::Service {
 public:
  // `region_socket` is the path of the socket for shared memory, or empty if no memory is shared.
  InfoService(const catalog::OperatorCatalog& operators, const scenes::ResidentScenes& residents,
              engine::Engine& engine, const Limits& limits, std::string version, std::string region_socket)
      : operators_(operators),
        residents_(residents),
        engine_(engine),
        limits_(limits),
        version_(std::move(version)),
        region_socket_(std::move(region_socket)) {}

  // This call asks for no admission, so that a full server still answers it.
  grpc::Status GetInfo(grpc::ServerContext* context, const v1::GetInfoRequest*,
                       v1::GetInfoResponse* response) override {
    return finish(*context, base::guarded([&] { return get(*response); }));
  }

 private:
  absl::Status get(v1::GetInfoResponse& response) const;
  void fill_device(v1::DeviceInfo& device) const;
  void fill_limits(v1::Limits& limits) const;

  const catalog::OperatorCatalog& operators_;
  const scenes::ResidentScenes& residents_;
  engine::Engine& engine_;
  const Limits& limits_;
  const std::string version_, region_socket_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace isofield::rpc
