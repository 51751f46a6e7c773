#include "rpc/unreadable_requests.h"

#include <absl/strings/str_cat.h>
#include <absl/strings/str_replace.h>
#include <google/protobuf/descriptor.h>

#include "rpc/status.h"

namespace isofield::rpc {
namespace {

using grpc::experimental::InterceptionHookPoints;
using grpc::experimental::ServerRpcInfo;

// Evaluate reads its requests itself, from bytes. An interceptor would only cost it time.
constexpr absl::string_view kEvaluate = "/isofield.v1.FieldService/Evaluate";

// Returns the full name of the request message of a method; the method has the form "/package.Service/Method".
std::string request_type(const char* method) {
  const std::string name = absl::StrReplaceAll(absl::string_view(method).substr(1), {{"/", "."}});
  const auto* descriptor = google::protobuf::DescriptorPool::generated_pool()->FindMethodByName(name);
  return descriptor ? descriptor->input_type()->full_name() : absl::StrCat("the request of ", method);
}

// Checks one call. It looks at the request after it has been read, and changes the status before it is sent.
class RequestCheck final : public grpc::experimental::Interceptor {
 public:
  explicit RequestCheck(const char* method) : method_(method) {}

  void Intercept(grpc::experimental::InterceptorBatchMethods* methods) override {
    if (methods->QueryInterceptionHookPoint(InterceptionHookPoints::POST_RECV_MESSAGE)) {
      is_unreadable_ = methods->GetRecvMessage() == nullptr;
    }
    if (is_unreadable_ && methods->QueryInterceptionHookPoint(InterceptionHookPoints::PRE_SEND_STATUS)) {
      methods->ModifySendStatus(to_grpc(unreadable(request_type(method_))));
    }
    methods->Proceed();
  }

 private:
  const char* const method_;
  bool is_unreadable_ = false;
};

class RequestChecks final : public grpc::experimental::ServerInterceptorFactoryInterface {
 public:
  grpc::experimental::Interceptor* CreateServerInterceptor(ServerRpcInfo* info) override {
    // Streams of requests are left out, since gRPC does not distinguish an unreadable request from the end of a stream.
    const bool has_one_request =
        info->type() == ServerRpcInfo::Type::UNARY || info->type() == ServerRpcInfo::Type::SERVER_STREAMING;
    return has_one_request && info->method() != kEvaluate ? new RequestCheck(info->method()) : nullptr;
  }
};

}  // namespace

absl::Status unreadable(const std::string& type) {
  return absl::InvalidArgumentError(
      absl::StrCat("the request cannot be read: expected the bytes of a ", type,
                   ", whose fields have the types that the .proto file states, and whose strings are UTF-8"));
}

std::unique_ptr<grpc::experimental::ServerInterceptorFactoryInterface> refuse_unreadable_requests() {
  return std::make_unique<RequestChecks>();
}

}  // namespace isofield::rpc
