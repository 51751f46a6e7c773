// From the house's statuses to gRPC's.
#pragma once

#include <absl/status/status.h>
#include <grpcpp/support/status.h>

namespace isofield::rpc {

// The codes are the same numbers by design.
inline grpc::Status to_grpc(const absl::Status& status) {
  if (status.ok()) return grpc::Status::OK;
  return {static_cast<grpc::StatusCode>(status.code()), std::string(status.message())};
}

}  // namespace isofield::rpc
