// What any gRPC tool finds: reflection, health, and GetInfo.
#include <gtest/gtest.h>

#include "integration/daemon.h"
#include "integration/peer.h"
#include "integration/raw_call.h"

namespace isofield::integration_test {
namespace {

// ServerReflectionRequest{list_services: "*"}, as bytes: field 7, length 1.
const std::string kListServices("\x3a\x01*", 3);
// HealthCheckResponse{status: SERVING}.
const std::string kServing("\x08\x01", 2);

TEST(Services, ReflectionListsThem) {
  const Peer peer(shared_daemon().address());
  const RawAnswer answer =
      raw_call(peer.channel(), "/grpc.reflection.v1alpha.ServerReflection/ServerReflectionInfo", kListServices);
  EXPECT_TRUE(ok(answer.status));
  for (const char* name : {"isofield.v1.SceneService", "isofield.v1.FieldService", "isofield.v1.MeshService",
                           "isofield.v1.InfoService", "isofield.v1.OperatorService", "grpc.health.v1.Health"}) {
    EXPECT_NE(answer.message.find(name), std::string::npos) << name;
  }
}

TEST(Services, HealthIsServing) {
  const Peer peer(shared_daemon().address());
  const RawAnswer answer = raw_call(peer.channel(), "/grpc.health.v1.Health/Check", "");
  EXPECT_TRUE(ok(answer.status));
  EXPECT_EQ(answer.message, kServing);
}

TEST(Services, UnknownMethodsAndUnreadableMessagesDoNoHarm) {
  const Peer peer(shared_daemon().address());
  EXPECT_EQ(raw_call(peer.channel(), "/isofield.v1.SceneService/Nothing", "").status.error_code(),
            grpc::StatusCode::UNIMPLEMENTED);
  for (const char* method :
       {"SceneService/PutScene", "FieldService/Evaluate", "FieldService/EvaluateStream", "FieldService/EvaluateGrid",
        "MeshService/Mesh", "InfoService/GetInfo", "OperatorService/PutOperator", "OperatorService/EvaluateOperator",
        "OperatorService/PickOpening"}) {
    // A message that ends within a field, and one with a field of a wrong type.
    for (const std::string& message : {std::string("\x0a\xff\xff\xff\x7f", 5), std::string(64, '\xff')}) {
      EXPECT_FALSE(raw_call(peer.channel(), std::string("/isofield.v1.") + method, message).status.ok()) << method;
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
                 "--max-queued-points", "18"});
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
  EXPECT_EQ(limits.max_operators(), 16u);
}

}  // namespace
}  // namespace isofield::integration_test
