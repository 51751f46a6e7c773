#include "rpc/reflection_service.h"

#include <absl/container/flat_hash_set.h>
#include <absl/strings/str_cat.h>
#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>

#include <algorithm>

#include "base/quoted.h"
#include "grpc/health/v1/health.pb.h"

namespace isofield::rpc {
namespace {

namespace reflection = grpc::reflection::v1;
using google::protobuf::DescriptorPool;
using google::protobuf::FileDescriptor;

constexpr char kHealth[] = "grpc.health.v1.Health", kAlpha[] = "grpc.reflection.v1alpha.ServerReflection";

const DescriptorPool& pool() {
  return *DescriptorPool::generated_pool();
}

void refuse(const std::string& what, const std::string& name, reflection::ServerReflectionResponse& response) {
  response.mutable_error_response()->set_error_code(static_cast<int>(grpc::StatusCode::NOT_FOUND));
  response.mutable_error_response()->set_error_message(absl::StrCat("no ", what, " is named ", base::quoted(name)));
}

// Adds a file and the files that it imports, except for those that this stream has sent before. A file that the client
// asks for is always added.
void add_files(const FileDescriptor& file, bool is_asked_for, absl::flat_hash_set<std::string>& sent,
               reflection::FileDescriptorResponse& response) {
  if (!sent.insert(std::string(file.name())).second && !is_asked_for) return;
  google::protobuf::FileDescriptorProto message;
  file.CopyTo(&message);
  response.add_file_descriptor_proto(message.SerializeAsString());
  for (int i = 0; i < file.dependency_count(); ++i) add_files(*file.dependency(i), false, sent, response);
}

}  // namespace

ReflectionService::ReflectionService(std::vector<std::string> services) : services_(std::move(services)) {
  services_.insert(services_.end(), {grpc::reflection::v1::ServerReflection::service_full_name(), kHealth, kAlpha});
  std::sort(services_.begin(), services_.end());
  // Links the description of the health check, which libgrpc++ serves without one.
  grpc::health::v1::HealthCheckRequest::descriptor();
}

grpc::Status ReflectionService::ServerReflectionInfo(
    grpc::ServerContext*,
    grpc::ServerReaderWriter<reflection::ServerReflectionResponse, reflection::ServerReflectionRequest>* stream) {
  absl::flat_hash_set<std::string> sent;
  reflection::ServerReflectionRequest request;
  while (stream->Read(&request)) {
    reflection::ServerReflectionResponse response;
    response.set_valid_host(request.host());
    *response.mutable_original_request() = request;
    const auto answer = [&](const FileDescriptor* file, const std::string& what, const std::string& name) {
      if (!file) return refuse(what, name, response);
      add_files(*file, true, sent, *response.mutable_file_descriptor_response());
    };
    switch (request.message_request_case()) {
      case reflection::ServerReflectionRequest::kFileByFilename:
        answer(pool().FindFileByName(request.file_by_filename()), "file", request.file_by_filename());
        break;
      case reflection::ServerReflectionRequest::kFileContainingSymbol:
        answer(pool().FindFileContainingSymbol(request.file_containing_symbol()), "symbol",
               request.file_containing_symbol());
        break;
      case reflection::ServerReflectionRequest::kFileContainingExtension: {
        const reflection::ExtensionRequest& asked = request.file_containing_extension();
        const auto* type = pool().FindMessageTypeByName(asked.containing_type());
        const auto* extension = type ? pool().FindExtensionByNumber(type, asked.extension_number()) : nullptr;
        answer(extension ? extension->file() : nullptr, "extension",
               absl::StrCat(asked.containing_type(), " ", asked.extension_number()));
        break;
      }
      case reflection::ServerReflectionRequest::kAllExtensionNumbersOfType: {
        const std::string& name = request.all_extension_numbers_of_type();
        const auto* type = pool().FindMessageTypeByName(name);
        if (!type) {
          refuse("message", name, response);
          break;
        }
        std::vector<const google::protobuf::FieldDescriptor*> extensions;
        pool().FindAllExtensions(type, &extensions);
        reflection::ExtensionNumberResponse& numbers = *response.mutable_all_extension_numbers_response();
        numbers.set_base_type_name(name);
        for (const auto* extension : extensions) numbers.add_extension_number(extension->number());
        break;
      }
      case reflection::ServerReflectionRequest::kListServices:
        for (const std::string& name : services_) {
          response.mutable_list_services_response()->add_service()->set_name(name);
        }
        break;
      default:
        response.mutable_error_response()->set_error_code(static_cast<int>(grpc::StatusCode::INVALID_ARGUMENT));
        response.mutable_error_response()->set_error_message("message_request: expected one of its fields");
    }
    if (!stream->Write(response)) break;
  }
  return grpc::Status::OK;
}

}  // namespace isofield::rpc
