// Tests what any gRPC tool finds: reflection, health, and GetInfo.
#include <absl/strings/str_cat.h>
#include <google/protobuf/descriptor.h>
#include <gtest/gtest.h>

#include "integration/daemon.h"
#include "integration/peer.h"
#include "integration/raw_call.h"

namespace isofield::integration_test {
namespace {

// ServerReflectionRequest{list_services: "*"}, as bytes: field 7, length 1.
const std::string kListServices("\x3a\x01*", 3);
const std::vector<std::string> kReflections{"/grpc.reflection.v1.ServerReflection/ServerReflectionInfo",
                                            "/grpc.reflection.v1alpha.ServerReflection/ServerReflectionInfo"};
// HealthCheckResponse{status: SERVING}.
const std::string kServing("\x08\x01", 2);

TEST(Services, ReflectionListsThem) {
  const Peer peer(shared_daemon().address());
  for (const std::string& version : kReflections) {
    const RawAnswer answer = raw_call(peer.channel(), version, kListServices);
    EXPECT_TRUE(ok(answer.status)) << version;
    for (const char* name : {"isofield.v1.SceneService", "isofield.v1.FieldService", "isofield.v1.MeshService",
                             "isofield.v1.InfoService", "isofield.v1.OperatorService", "isofield.v1.SurfaceService",
                             "grpc.health.v1.Health", "grpc.reflection.v1.ServerReflection"}) {
      EXPECT_NE(answer.message.find(name), std::string::npos) << version << ": " << name;
    }
  }
}

// Both versions of reflection describe symbols by their file and the files that it imports.
TEST(Services, ReflectionDescribesThem) {
  const Peer peer(shared_daemon().address());
  for (const std::string& version : kReflections) {
    const auto describe = [&](const std::string& symbol) {
      const std::string request = absl::StrCat("\x22", std::string(1, static_cast<char>(symbol.size())), symbol);
      const RawAnswer answer = raw_call(peer.channel(), version, request);
      EXPECT_TRUE(ok(answer.status)) << version;
      return answer.message;
    };
    for (const char* symbol : {"grpc.health.v1.Health", "grpc.health.v1.HealthCheckRequest"}) {
      EXPECT_NE(describe(symbol).find("grpc/health/v1/health.proto"), std::string::npos) << version;
    }
    const std::string evaluate = describe("isofield.v1.FieldService.Evaluate");
    for (const char* file : {"isofield/v1/field_service.proto", "isofield/v1/scene.proto"}) {
      EXPECT_NE(evaluate.find(file), std::string::npos) << version << ": " << file;
    }
    EXPECT_EQ(describe("isofield.v1.Nothing").find("field_service.proto"), std::string::npos);
  }
}

TEST(Services, ReflectionSaysWhatItDoesNotKnow) {
  const Peer peer(shared_daemon().address());
  const std::string name = "isofield.v1.No\nthing";
  const RawAnswer answer = raw_call(peer.channel(), kReflections[0],
                                    absl::StrCat("\x22", std::string(1, static_cast<char>(name.size())), name));
  EXPECT_TRUE(ok(answer.status));
  EXPECT_NE(answer.message.find("no symbol is named 'isofield.v1.No\\nthing'"), std::string::npos);
}

TEST(Services, HealthIsServing) {
  const Peer peer(shared_daemon().address());
  const RawAnswer answer = raw_call(peer.channel(), "/grpc.health.v1.Health/Check", "");
  EXPECT_TRUE(ok(answer.status));
  EXPECT_EQ(answer.message, kServing);
  for (const std::string name : {"isofield.v1.FieldService", "isofield.v1.SurfaceService"}) {
    const RawAnswer of_one = raw_call(peer.channel(), "/grpc.health.v1.Health/Check",
                                      absl::StrCat("\x0a", std::string(1, static_cast<char>(name.size())), name));
    EXPECT_TRUE(ok(of_one.status)) << name;
    EXPECT_EQ(of_one.message, kServing) << name;
  }
  EXPECT_EQ(raw_call(peer.channel(), "/grpc.health.v1.Health/Check", "\x0a\x02no").status.error_code(),
            grpc::StatusCode::NOT_FOUND);
}

TEST(Services, UnknownMethodsDoNoHarm) {
  const Peer peer(shared_daemon().address());
  EXPECT_EQ(raw_call(peer.channel(), "/isofield.v1.SceneService/Nothing", "").status.error_code(),
            grpc::StatusCode::UNIMPLEMENTED);
  expect_serving(shared_daemon().address());
}

// Finds every method of the contract, so that an added one is tested without being named here.
std::vector<const google::protobuf::MethodDescriptor*> all_methods() {
  std::vector<const google::protobuf::MethodDescriptor*> methods;
  for (const auto* file : {v1::EvaluateRequest::descriptor()->file(), v1::MeshRequest::descriptor()->file(),
                           v1::PutSceneRequest::descriptor()->file(), v1::PutOperatorRequest::descriptor()->file(),
                           v1::CastRaysRequest::descriptor()->file(), v1::GetInfoRequest::descriptor()->file()}) {
    for (int i = 0; i < file->service_count(); ++i) {
      for (int j = 0; j < file->service(i)->method_count(); ++j) methods.push_back(file->service(i)->method(j));
    }
  }
  return methods;
}

TEST(Services, RequestsThatCannotBeReadAreInvalidArguments) {
  const Peer peer(shared_daemon().address());
  EXPECT_GE(all_methods().size(), 23u);
  for (const auto* method : all_methods()) {
    const std::string name = absl::StrCat("/", method->service()->full_name(), "/", method->name());
    // The first message ends within a field, and the first tag of the second one is invalid.
    std::vector<std::string> messages{std::string("\x0a\xff\xff\xff\x7f", 5), std::string(64, '\xff')};
    // If a request begins with a string, the third message holds one that is not UTF-8.
    const auto* first = method->input_type()->FindFieldByNumber(1);
    if (first && first->type() == google::protobuf::FieldDescriptor::TYPE_STRING) messages.emplace_back("\x0a\x01\xff");
    for (const std::string& message : messages) {
      const grpc::Status status = raw_call(peer.channel(), name, message).status;
      SCOPED_TRACE(name);
      expect_refused(status, grpc::StatusCode::INVALID_ARGUMENT, {"cannot be read", method->input_type()->full_name()});
    }
  }
  expect_serving(shared_daemon().address());
}

TEST(Services, InfoStatesDeviceAndLimits) {
  Peer peer(shared_daemon().address());
  const v1::GetInfoResponse info = peer.info();
  EXPECT_FALSE(info.version().empty());
  EXPECT_FALSE(info.device().name().empty());
  EXPECT_FALSE(info.device().driver().empty());
  EXPECT_EQ(info.device().vulkan_version().substr(0, 2), "1.");
  EXPECT_FALSE(info.device().type().empty());
  EXPECT_GT(info.device().subgroup_size(), 0u);
  EXPECT_GE(info.device().max_buffer_bytes(), 1u << 27);
  EXPECT_GE(info.device().profile_size(), 20);
  for (const v1::TuningNumber& number : info.device().profile()) {
    EXPECT_FALSE(number.name().empty() || number.unit().empty() || number.meaning().empty()) << number.name();
    if (number.name() == "points_per_job") {
      EXPECT_EQ(number.value(), info.device().subgroup_size());
    }
  }
  EXPECT_GE(info.limits().max_nodes(), 100'000u);
  EXPECT_GE(info.limits().max_primitives(), 100'000u);
  EXPECT_GE(info.limits().max_stack_depth(), 8u);
  EXPECT_GE(info.limits().max_scenes(), 1u);
  EXPECT_EQ(info.limits().max_operators(), 10'000u);
  EXPECT_GE(info.limits().max_message_bytes(), 4u << 20);
  EXPECT_GE(info.limits().max_points_per_message(), 65'536u);
  EXPECT_GE(info.limits().max_grid_points(), 1u << 24);
  EXPECT_GE(info.limits().max_mesh_cells(), 1u << 20);
  EXPECT_GE(peer.info().uptime_seconds(), info.uptime_seconds());
}

TEST(Services, LimitsAreThoseOfTheFlags) {
  Daemon daemon({"--max-nodes",         "11",    "--max-primitives",         "12",   "--max-scenes",          "13",
                 "--max-message-bytes", "70000", "--max-points-per-message", "14",   "--max-grid-points",     "15",
                 "--max-operators",     "16",    "--max-mesh-cells",         "6400", "--max-queued-requests", "17",
                 "--max-queued-points", "18",    "--max-running-requests",   "19",   "--max-running-points",  "20"});
  Peer peer(daemon.address());
  const v1::Limits limits = peer.info().limits();
  EXPECT_EQ(limits.max_nodes(), 11u);
  EXPECT_EQ(limits.max_primitives(), 12u);
  EXPECT_EQ(limits.max_scenes(), 13u);
  EXPECT_EQ(limits.max_message_bytes(), 70'000u);
  EXPECT_EQ(limits.max_points_per_message(), 14u);
  EXPECT_EQ(limits.max_grid_points(), 15u);
  EXPECT_EQ(limits.max_mesh_cells(), 6400u);
  EXPECT_EQ(limits.max_queued_requests(), 17u);
  EXPECT_EQ(limits.max_queued_points(), 18u);
  EXPECT_EQ(limits.max_running_requests(), 19u);
  EXPECT_EQ(limits.max_running_points(), 20u);
  EXPECT_EQ(limits.max_operators(), 16u);
}

}  // namespace
}  // namespace isofield::integration_test
