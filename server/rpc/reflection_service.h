// Implements grpc.reflection.v1.ServerReflection, by which tools find out what the server offers. It also links the
// description of grpc.health.v1.Health.
#pragma once

#include <grpcpp/grpcpp.h>

#include <string>
#include <vector>

#include "grpc/reflection/v1/reflection.grpc.pb.h"

namespace isofield::rpc {

// Answers from the descriptions that are linked into the program. libgrpc++_reflection 1.51 only serves v1alpha, which
// tools try after v1 or not at all.
class ReflectionService final : public grpc::reflection::v1::ServerReflection::Service {
 public:
  // `services` has the full names of the services to list. Health and v1alpha, which libgrpc++ adds by itself, are
  // listed too.
  explicit ReflectionService(std::vector<std::string> services);

  grpc::Status ServerReflectionInfo(
      grpc::ServerContext*, grpc::ServerReaderWriter<grpc::reflection::v1::ServerReflectionResponse,
                                                     grpc::reflection::v1::ServerReflectionRequest>* stream) override;

 private:
  std::vector<std::string> services_;
};

}  // namespace isofield::rpc
