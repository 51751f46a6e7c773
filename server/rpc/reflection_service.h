// grpc.reflection.v1.ServerReflection, and the description of grpc.health.v1.Health.
#pragma once

#include <grpcpp/grpcpp.h>

#include <string>
#include <vector>

#include "grpc/reflection/v1/reflection.grpc.pb.h"

namespace isofield::rpc {

// Answers from the descriptions that are linked into the program. libgrpc++_reflection 1.51 serves v1alpha, which new
// tools ask second or not at all.
class ReflectionService final : public grpc::reflection::v1::ServerReflection::Service {
 public:
  // `services`: full names. The services that libgrpc++ adds by itself, health and v1alpha, are listed too.
  explicit ReflectionService(std::vector<std::string> services);

  grpc::Status ServerReflectionInfo(
      grpc::ServerContext*,
      grpc::ServerReaderWriter<grpc::reflection::v1::ServerReflectionResponse,
                               grpc::reflection::v1::ServerReflectionRequest>* stream) override;

 private:
  std::vector<std::string> services_;
};

}  // namespace isofield::rpc
