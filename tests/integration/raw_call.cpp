#include "integration/raw_call.h"

#include <grpcpp/client_context.h>
#include <grpcpp/completion_queue.h>
#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/support/byte_buffer.h>

#include "integration/peer.h"

namespace isofield::integration_test {

RawAnswer raw_call(const std::shared_ptr<grpc::Channel>& channel, const std::string& method,
                   const std::string& message) {
  grpc::GenericStub stub(channel);
  LimitedContext context;
  grpc::CompletionQueue queue;
  // Only one operation runs at a time, so the tag is not needed.
  const auto finish_operation = [&queue] {
    void* tag = nullptr;
    bool succeeded = false;
    return queue.Next(&tag, &succeeded) && succeeded;
  };
  const auto call = stub.PrepareCall(&context, method, &queue);
  call->StartCall(nullptr);
  finish_operation();
  const grpc::Slice slice(message);
  call->WriteLast(grpc::ByteBuffer(&slice, 1), grpc::WriteOptions(), nullptr);
  finish_operation();
  RawAnswer answer;
  grpc::ByteBuffer received;
  call->Read(&received, nullptr);
  if (finish_operation()) {
    grpc::Slice joined;
    if (received.DumpToSingleSlice(&joined).ok()) {
      answer.message.assign(reinterpret_cast<const char*>(joined.begin()), joined.size());
    }
  }
  call->Finish(&answer.status, nullptr);
  finish_operation();
  queue.Shutdown();
  finish_operation();
  return answer;
}

}  // namespace isofield::integration_test
