#include "address.h"

#include <absl/strings/match.h>
#include <gtest/gtest.h>

#include "errors.h"

namespace isofield {
namespace {

TEST(Address, AcceptsItsThreeForms) {
  EXPECT_EQ(*grpc_target("127.0.0.1:50051"), "dns:///127.0.0.1:50051");
  EXPECT_EQ(*grpc_target("localhost:1"), "dns:///localhost:1");
  EXPECT_EQ(*grpc_target("[::1]:65535"), "dns:///[::1]:65535");
  EXPECT_EQ(*grpc_target("unix:/run/isofield.sock"), "unix:/run/isofield.sock");
  EXPECT_EQ(*grpc_target("unix:relative.sock"), "unix:relative.sock");
}

TEST(Address, RefusesAllElseAndNamesTheForms) {
  for (const char* bad : {"", ":", "host", "host:", ":50051", "host:0", "host:65536", "host:-1", "host:+5", "host:5x",
                          "::1:50051", "a b:1", "http://host:1", "unix:"}) {
    const auto target = grpc_target(bad);
    EXPECT_EQ(target.status().code(), absl::StatusCode::kInvalidArgument) << bad;
    EXPECT_TRUE(absl::StrContains(target.status().message(), "HOST:PORT")) << bad;
  }
  EXPECT_FALSE(grpc_target("unix:" + std::string(200, 'x')).ok());
}

TEST(Errors, SayWhatToDo) {
  const auto status =
      from_grpc(grpc::Status(grpc::StatusCode::UNAVAILABLE, "failed to connect: Connection refused"), "unix:/x");
  EXPECT_EQ(status.code(), absl::StatusCode::kUnavailable);
  EXPECT_TRUE(absl::StrContains(status.message(), "nothing listens at unix:/x; start isofieldd there")) << status;
  EXPECT_TRUE(absl::StrContains(
      from_grpc(grpc::Status(grpc::StatusCode::UNAVAILABLE, "DNS resolution failed"), "nowhere:1").message(),
      "no isofieldd answers at nowhere:1 (DNS"));
  EXPECT_TRUE(absl::StrContains(
      from_grpc(grpc::Status(grpc::StatusCode::UNAVAILABLE, "Socket closed"), "unix:/x").message(), "was lost"));
  EXPECT_TRUE(absl::StrContains(from_grpc(grpc::Status(grpc::StatusCode::UNIMPLEMENTED, ""), "unix:/x").message(),
                                "this version"));
  // The server's own message stays as it is.
  EXPECT_EQ(from_grpc(grpc::Status(grpc::StatusCode::NOT_FOUND, "no scene \"a\""), "unix:/x"),
            absl::NotFoundError("no scene \"a\""));
  EXPECT_TRUE(from_grpc(grpc::Status::OK, "unix:/x").ok());
}

}  // namespace
}  // namespace isofield
