#include "rpc/status.h"

#include "base/quoted.h"

namespace isofield::rpc {

grpc::Status to_grpc(const absl::Status& status) {
  if (status.ok()) return grpc::Status::OK;
  return {static_cast<grpc::StatusCode>(status.code()),
          base::printable(status.message(), kMaxStatusBytes, kMaxStatusBytes)};
}

absl::Status client_gone() {
  return absl::CancelledError("the client is gone");
}

}  // namespace isofield::rpc
