#include "shared_memory.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <thread>
#include <utility>

#include "isofield/v1/shared_memory.pb.h"
#include "test_support.h"

namespace isofield {
namespace {

constexpr std::size_t kBytes = 4096;

// Answers the first connection to a unix socket by one packet, or by none where the packet is empty.
class Answerer {
 public:
  explicit Answerer(std::string packet) : packet_(std::move(packet)) {
    sockaddr_un name{};
    name.sun_family = AF_UNIX;
    std::memcpy(name.sun_path, path().data(), path().size());
    listener_ = socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0);
    EXPECT_EQ(bind(listener_, reinterpret_cast<const sockaddr*>(&name), sizeof(name)), 0);
    EXPECT_EQ(listen(listener_, 1), 0);
    thread_ = std::thread([this] { answer(); });
  }
  ~Answerer() {
    thread_.join();
    close(listener_);
  }

  std::string path() const { return folder_.path("s"); }

 private:
  void answer() {
    const int connection = accept(listener_, nullptr, nullptr);
    char version = 0;
    EXPECT_EQ(recv(connection, &version, 1, 0), 1);
    if (!packet_.empty()) {
      EXPECT_EQ(send(connection, packet_.data(), packet_.size(), MSG_NOSIGNAL), static_cast<ssize_t>(packet_.size()));
    }
    close(connection);
  }

  const TemporaryDirectory folder_;
  const std::string packet_;
  int listener_ = -1;
  std::thread thread_;
};

std::string packet(const std::string& region, absl::StatusCode code, const std::string& message) {
  v1::OpenRegionResponse response;
  response.set_region(region);
  response.set_code(static_cast<int>(code));
  response.set_message(message);
  return response.SerializeAsString();
}

absl::Status refusal_of(const std::string& answer) {
  const Answerer answerer(answer);
  return SharedMemory::open(answerer.path(), kBytes).status();
}

TEST(SharedMemory, HasTheRegionThatTheDaemonNames) {
  const Answerer answerer(packet("0123456789abcdef", absl::StatusCode::kOk, ""));
  const auto memory = SharedMemory::open(answerer.path(), kBytes);
  ASSERT_TRUE(memory.ok()) << memory.status();
  EXPECT_EQ((*memory)->region(), "0123456789abcdef");
  (*memory)->data()[kBytes - 1] = std::byte{1};
}

TEST(SharedMemory, PassesTheErrorOfTheDaemonOn) {
  const absl::Status status = refusal_of(packet("", absl::StatusCode::kPermissionDenied, "another user"));
  EXPECT_EQ(status, absl::PermissionDeniedError("another user"));
}

TEST(SharedMemory, RefusesAnswersThatAreNone) {
  for (const auto& [answer, what] : {std::pair(std::string(), "closed the connection without an answer"),
                                     std::pair(std::string("\xff\xff"), "no OpenRegionResponse"),
                                     std::pair(packet("", absl::StatusCode::kOk, "fine"), "neither a region nor")}) {
    errno = 0;
    const absl::Status status = refusal_of(answer);
    EXPECT_EQ(status.code(), absl::StatusCode::kUnavailable) << status;
    EXPECT_NE(std::string(status.message()).find(what), std::string::npos) << status;
    EXPECT_EQ(std::string(status.message()).find("Success"), std::string::npos) << status;
  }
}

TEST(SharedMemory, TellsWhyItCannotConnect) {
  const TemporaryDirectory folder;
  const absl::Status missing = SharedMemory::open(folder.path("none"), kBytes).status();
  EXPECT_EQ(missing.code(), absl::StatusCode::kUnavailable);
  EXPECT_NE(std::string(missing.message()).find("No such file"), std::string::npos) << missing;
  const absl::Status too_long = SharedMemory::open(std::string(200, 'x'), kBytes).status();
  EXPECT_NE(std::string(too_long.message()).find("File name too long"), std::string::npos) << too_long;
}

}  // namespace
}  // namespace isofield
