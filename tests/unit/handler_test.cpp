// Tests how a call passes on a handler's status, its exceptions and answers that are too large.
#include "rpc/handler.h"

#include <absl/strings/match.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "isofield/v1/surface_service.pb.h"

namespace isofield::rpc {
namespace {

using grpc::StatusCode;

class Handler : public testing::Test {
 protected:
  template <class Handle>
  grpc::Status served(const Handle& handle) {
    return serve(context_, admission_, handle);
  }

  grpc::ServerContext context_;
  Admission admission_{{.max_requests = 1, .max_points = 100, .flags = "--most"}};
};

TEST_F(Handler, PassesTheStatusOn) {
  EXPECT_TRUE(served([](Call&) { return absl::OkStatus(); }).ok());
  const grpc::Status status = served([](Call&) { return absl::NotFoundError("no scene"); });
  EXPECT_EQ(status.error_code(), StatusCode::NOT_FOUND);
  EXPECT_EQ(status.error_message(), "no scene");
}

TEST_F(Handler, TurnsExceptionsIntoStatuses) {
  const auto thrown = [&](const auto& error) { return served([&](Call&) -> absl::Status { throw error; }); };
  EXPECT_EQ(thrown(std::bad_alloc()).error_code(), StatusCode::RESOURCE_EXHAUSTED);
  const grpc::Status unexpected = thrown(std::out_of_range("row 7"));
  EXPECT_EQ(unexpected.error_code(), StatusCode::INTERNAL);
  EXPECT_TRUE(absl::StrContains(unexpected.error_message(), "row 7")) << unexpected.error_message();
  EXPECT_EQ(thrown(7).error_code(), StatusCode::INTERNAL);
  EXPECT_TRUE(served([](Call&) { return absl::OkStatus(); }).ok()) << "none of them holds a place";
}

TEST_F(Handler, GuardsWhatReturnsAValue) {
  const auto made = base::guarded([]() -> absl::StatusOr<int> { throw std::bad_alloc(); });
  EXPECT_EQ(made.status().code(), absl::StatusCode::kResourceExhausted);
  EXPECT_EQ(base::guarded([]() -> absl::StatusOr<int> { return 7; }).value(), 7);
}

TEST_F(Handler, RefusesWhatIsNotAdmitted) {
  {
    const Admission::Ticket other = admission_.admit().value();
    bool is_called = false;
    const grpc::Status status = served([&](Call&) {
      is_called = true;
      return absl::OkStatus();
    });
    EXPECT_EQ(status.error_code(), StatusCode::RESOURCE_EXHAUSTED);
    EXPECT_FALSE(is_called);
  }
  EXPECT_TRUE(served([](Call& call) { return call.admit(1000); }).ok());
  EXPECT_TRUE(served([](Call& call) { return call.admit(1000); }).ok()) << "the first one is done";
}

TEST_F(Handler, LimitsAnswersAndWritesNumbersWhereAsked) {
  v1::ContainsRequest request;
  v1::ContainsResponse response;
  const auto fill = [&](Call&) {
    const std::vector<std::uint8_t> inside{1, 0, 1};
    set_rows(std::span<const std::uint8_t>(inside), 1, *response.mutable_inside());
    return absl::OkStatus();
  };
  const auto limited = [&] { return serve_limited(context_, admission_, request, response, "ask for less", fill); };
  EXPECT_TRUE(limited().ok());
  EXPECT_EQ(response.inside().data().size(), 3u);
  request.set_answer_in_numbers(true);
  EXPECT_TRUE(limited().ok());
  EXPECT_TRUE(response.inside().data().empty());
  EXPECT_EQ(response.inside().numbers_size(), 3);
  request.set_max_answer_bytes(1);
  const grpc::Status status = limited();
  EXPECT_EQ(status.error_code(), StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_TRUE(absl::StrContains(status.error_message(), "ask for less")) << status.error_message();
}

}  // namespace
}  // namespace isofield::rpc
