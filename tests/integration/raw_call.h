// Makes calls by name with messages as bytes, for services whose .proto is not ours, and for messages that no stub
// would send.
#pragma once

#include <grpcpp/channel.h>
#include <grpcpp/support/status.h>

#include <memory>
#include <string>

namespace isofield::integration_test {

struct RawAnswer {
  grpc::Status status;
  std::string message;  // only the first answer
};

// Makes the call. `method` has the form "/package.Service/Method".
RawAnswer raw_call(const std::shared_ptr<grpc::Channel>& channel, const std::string& method,
                   const std::string& message);

}  // namespace isofield::integration_test
