#include "rpc/handler.h"

#include <absl/strings/str_cat.h>

namespace isofield::rpc {

grpc::Status finish(grpc::ServerContext& context, const absl::Status& status) {
  if (const auto ms = retry_after_ms(status)) {
    context.AddTrailingMetadata("grpc-retry-pushback-ms", absl::StrCat(*ms));
  }
  return to_grpc(status);
}

}  // namespace isofield::rpc
