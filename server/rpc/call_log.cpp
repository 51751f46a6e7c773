#include "rpc/call_log.h"

#include <absl/status/status.h>
#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>
#include <absl/strings/str_format.h>
#include <absl/strings/string_view.h>
#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

#include <algorithm>
#include <chrono>
#include <optional>

#include "isofield/v1/mesh_service.pb.h"
#include "isofield/v1/operator_service.pb.h"
#include "isofield/v1/scene.pb.h"

namespace isofield::rpc {
namespace {

using Clock = std::chrono::steady_clock;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using grpc::experimental::InterceptionHookPoints;

constexpr char kPrefix[] = "/isofield.v1.";
constexpr std::size_t kLongestName = 80;

double milliseconds(Clock::duration d) {
  return std::chrono::duration<double, std::milli>(d).count();
}

// Tells whether gRPC reads and writes the requests and answers of a method as messages. Evaluate and EvaluateStream
// handle bytes, on whichever thread is free, and fill in their notes themselves.
bool is_of_messages(absl::string_view method) {
  return !absl::EndsWith(method, "/Evaluate") && !absl::EndsWith(method, "/EvaluateStream");
}

// Tells whether gRPC parses the requests of a method, too. TrackMesh gets the bytes of its requests.
bool has_parsed_requests(absl::string_view method) {
  return is_of_messages(method) && !absl::EndsWith(method, "/TrackMesh");
}

// Tells whether the field "name" of a request is the name of an operator. In all others it names a scene.
bool names_operator(const Message& request) {
  return request.GetDescriptor()->file() == v1::GetOperatorRequest::descriptor()->file();
}

// Notes which scene or operator a request is about, and how many points or rays it asks for.
void note_request(const Message& request, CallNotes& notes) {
  const google::protobuf::Reflection& reflection = *request.GetReflection();
  std::vector<const FieldDescriptor*> fields;
  reflection.ListFields(request, &fields);
  for (const FieldDescriptor* field : fields) {
    const std::string& name = field->name();
    if (name == "name" && field->type() == FieldDescriptor::TYPE_STRING) {
      const std::string subject = reflection.GetString(request, field);
      names_operator(request) ? notes.set_operator(subject) : notes.set_scene(subject);
    } else if (name == "counts" && field->cpp_type() == FieldDescriptor::CPPTYPE_UINT64) {
      std::uint64_t points = 1;
      for (int i = 0; i < reflection.FieldSize(request, field); ++i) {
        points *= reflection.GetRepeatedUInt64(request, field, i);
      }
      notes.add_work("points", points);
    } else if (field->cpp_type() != FieldDescriptor::CPPTYPE_MESSAGE || field->is_repeated()) {
      continue;
    } else if (field->message_type() == v1::SceneRef::descriptor()) {
      notes.set_scene(static_cast<const v1::SceneRef&>(reflection.GetMessage(request, field)));
    } else if (field->message_type() == v1::MeshRequest::descriptor()) {
      note_request(reflection.GetMessage(request, field), notes);
    } else if (field->message_type() == v1::Tensor::descriptor() && name != "directions") {
      const auto& tensor = static_cast<const v1::Tensor&>(reflection.GetMessage(request, field));
      if (tensor.shape_size() > 0) notes.add_work(name == "origins" ? "rays" : "points", tensor.shape(0));
    }
  }
}

// Notes the number of cells from the summary that ends the answer to a mesh request.
void note_response(const Message& response, CallNotes& notes) {
  const FieldDescriptor* const summary = response.GetDescriptor()->FindFieldByName("summary");
  if (!summary || summary->message_type() != v1::MeshSummary::descriptor()) return;
  const google::protobuf::Reflection& reflection = *response.GetReflection();
  if (!reflection.HasField(response, summary)) return;
  notes.add_work("cells", static_cast<const v1::MeshSummary&>(reflection.GetMessage(response, summary)).cells());
}

std::string outcome_text(const grpc::Status& status) {
  if (status.ok()) return "OK";
  return absl::StrCat(absl::StatusCodeToString(static_cast<absl::StatusCode>(status.error_code())), ": ",
                      status.error_message());
}

}  // namespace

void CallNotes::set_scene(const v1::SceneRef& scene) {
  set_scene(scene.has_inline_() ? "(inline)" : scene.name());
}

void CallNotes::set_subject(const char* what, std::string name) {
  const base::MutexLock lock(mutex_);
  // A call has one line in the log, whatever characters its client sends.
  for (char& c : name) c = c > ' ' && c < 0x7f ? c : '?';
  if (name.size() > kLongestName) name.replace(kLongestName, std::string::npos, "...");
  subject_ = name.empty() ? "" : absl::StrCat(what, "=", name);
}

void CallNotes::add_work(const char* unit, std::uint64_t count) {
  const base::MutexLock lock(mutex_);
  work_[unit] += count;
}

std::string CallNotes::text() const {
  const base::MutexLock lock(mutex_);
  std::string text;
  if (!subject_.empty()) absl::StrAppend(&text, " ", subject_);
  for (const auto& [unit, count] : work_) absl::StrAppend(&text, " ", unit, "=", count);
  return text;
}

// The interceptor of one call, which lives from the call's arrival to its end. If gRPC handles the method's messages,
// all functions run on the thread that handles the call.
class CallLog::Call final : public grpc::experimental::Interceptor {
 public:
  Call(CallLog& log, grpc::experimental::ServerRpcInfo& info)
      : log_(log), context_(info.server_context()), method_(info.method()), id_(++log.last_id_) {
    const base::MutexLock lock(log_.mutex_);
    log_.running_[context_] = &notes_;
  }
  ~Call() override {
    {
      const base::MutexLock lock(log_.mutex_);
      log_.running_.erase(context_);
    }
    if (start_ == Clock::time_point()) return;  // no call has come, since the server shuts down
    log_.sink_(
        absl::StrFormat("call %d %s%s: queue %.1f ms, kernels %.1f ms, device %.1f ms, transfer %.1f ms, "
                        "total %.1f ms, %s",
                        id_, method_.substr(sizeof(kPrefix) - 1), notes_.text(), milliseconds(notes_.times().queued()),
                        milliseconds(notes_.times().compiling()), milliseconds(notes_.times().on_device()),
                        milliseconds(transfer_), milliseconds(Clock::now() - start_), outcome_));
  }

  void Intercept(grpc::experimental::InterceptorBatchMethods* methods) override {
    const auto is_at = [&](InterceptionHookPoints point) { return methods->QueryInterceptionHookPoint(point); };
    if (is_at(InterceptionHookPoints::POST_RECV_INITIAL_METADATA)) {
      start_ = Clock::now();
      if (is_of_messages(method_)) timed_.emplace(notes_.times());
    }
    if (is_at(InterceptionHookPoints::POST_RECV_MESSAGE) && has_parsed_requests(method_) && methods->GetRecvMessage()) {
      note_request(*static_cast<const Message*>(methods->GetRecvMessage()), notes_);
    }
    if (is_at(InterceptionHookPoints::PRE_SEND_MESSAGE)) {
      sending_since_ = Clock::now();
      if (is_of_messages(method_) && methods->GetSendMessage()) {
        note_response(*static_cast<const Message*>(methods->GetSendMessage()), notes_);
      }
    }
    if (is_at(InterceptionHookPoints::POST_SEND_MESSAGE)) transfer_ += Clock::now() - sending_since_;
    if (is_at(InterceptionHookPoints::PRE_SEND_STATUS)) {
      timed_.reset();
      outcome_ = outcome_text(methods->GetSendStatus());
    }
    methods->Proceed();
  }

 private:
  CallLog& log_;
  const grpc::ServerContextBase* const context_;
  const absl::string_view method_;
  const std::uint64_t id_;
  CallNotes notes_;
  std::optional<engine::TimedScope> timed_;
  Clock::time_point start_, sending_since_;
  Clock::duration transfer_{0};
  std::string outcome_ = "the client is gone";
};

class CallLog::Calls final : public grpc::experimental::ServerInterceptorFactoryInterface {
 public:
  explicit Calls(CallLog& log) : log_(log) {}
  grpc::experimental::Interceptor* CreateServerInterceptor(grpc::experimental::ServerRpcInfo* info) override {
    return absl::StartsWith(info->method(), kPrefix) ? new Call(log_, *info) : nullptr;
  }

 private:
  CallLog& log_;
};

std::unique_ptr<grpc::experimental::ServerInterceptorFactoryInterface> CallLog::interceptors() {
  return std::make_unique<Calls>(*this);
}

CallNotes* CallLog::notes_of(const grpc::ServerContextBase& context) const {
  if (!is_on()) return nullptr;
  const base::MutexLock lock(mutex_);
  const auto found = running_.find(&context);
  return found == running_.end() ? nullptr : found->second;
}

}  // namespace isofield::rpc
