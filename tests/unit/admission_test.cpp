// Tests how many requests are admitted, what they count, and when a refused one may come again. The clock is a
// variable.
#include "rpc/admission.h"

#include <absl/strings/match.h>
#include <gtest/gtest.h>

#include <vector>

namespace isofield::rpc {
namespace {

using std::chrono::seconds;

class AdmissionTest : public testing::Test {
 protected:
  void expect_refused(const absl::Status& status) {
    EXPECT_EQ(status.code(), absl::StatusCode::kResourceExhausted) << status;
    EXPECT_GE(retry_after_ms(status).value_or(0), 1);
  }

  std::chrono::steady_clock::time_point now_{};
  Admission admission_{{.max_requests = 3, .max_points = 100, .flags = "--most"}, [this] { return now_; }};
};

TEST_F(AdmissionTest, RefusesMoreRequestsAtOnceUntilOneEnds) {
  std::vector<Admission::Ticket> tickets;
  for (int i = 0; i < 3; ++i) tickets.push_back(admission_.admit(1).value());
  const absl::Status refused = admission_.admit(1).status();
  expect_refused(refused);
  for (const char* part : {"3 requests with 3 points", "3 with 100", "--most", "try again in 1 ms"}) {
    EXPECT_TRUE(absl::StrContains(refused.message(), part)) << refused;
  }
  expect_refused(admission_.admit().status());
  tickets.pop_back();
  EXPECT_TRUE(admission_.admit(1).ok());
}

TEST_F(AdmissionTest, RefusesMorePointsButNeverThoseOfALoneRequest) {
  Admission::Ticket large = admission_.admit(1000).value();
  expect_refused(admission_.admit(1).status());
  EXPECT_TRUE(admission_.admit().ok()) << "a request without points needs no room for them";
  large = {};
  const Admission::Ticket fitting = admission_.admit(99).value();
  EXPECT_TRUE(admission_.admit(1).ok());
  expect_refused(admission_.admit(2).status());
}

TEST_F(AdmissionTest, PointsMayBeAddedWhenTheyAreKnown) {
  Admission::Ticket first = admission_.admit().value(), second = admission_.admit().value();
  EXPECT_TRUE(first.add(1000).ok()) << "no other has points";
  expect_refused(second.add(1));
  expect_refused(first.add(1));
  first = {};
  EXPECT_TRUE(second.add(1).ok()) << "what was added is gone with the request";
  EXPECT_TRUE(second.add(99).ok());
  expect_refused(admission_.admit(1).status());
}

TEST_F(AdmissionTest, CountsRequestsThatAreNotRefused) {
  std::vector<Admission::Ticket> streams;
  for (int i = 0; i < 5; ++i) streams.push_back(admission_.count(50));
  expect_refused(admission_.admit(1).status());
  streams.clear();
  EXPECT_TRUE(admission_.admit(100).ok());
}

TEST_F(AdmissionTest, ATicketThatIsMovedCountsOnce) {
  Admission::Ticket first = admission_.admit(60).value();
  Admission::Ticket second(std::move(first));
  Admission::Ticket third;
  third = std::move(second);
  expect_refused(admission_.admit(60).status());
  third = admission_.count(10);
  EXPECT_TRUE(admission_.admit(60).ok());
}

TEST_F(AdmissionTest, SaysWhenTheWorkWillBeDone) {
  for (int i = 0; i < 20; ++i) {
    const Admission::Ticket done = admission_.admit(99).value();
    now_ += seconds(2);
  }
  now_ += seconds(1000);  // there is nothing to do in this time
  const Admission::Ticket running = admission_.admit(99).value();
  EXPECT_NEAR(static_cast<double>(*retry_after_ms(admission_.admit(99).status())), 2000, 1);
  Admission::Ticket more = admission_.count(99'999);
  EXPECT_EQ(retry_after_ms(admission_.admit(99).status()), 10'000) << "at most";
}

TEST_F(AdmissionTest, RequestsThatEndTogetherCountTogether) {
  std::vector<Admission::Ticket> joined;
  for (int i = 0; i < 3; ++i) joined.push_back(admission_.admit(9).value());
  now_ += seconds(3);
  joined.clear();
  const Admission::Ticket running = admission_.admit(99).value();
  EXPECT_NEAR(static_cast<double>(*retry_after_ms(admission_.admit(99).status())), 10'000, 1)
      << "100 units at 10 a second";
}

TEST(RetryAfter, IsOfRefusalsByAdmissionAlone) {
  EXPECT_FALSE(retry_after_ms(absl::ResourceExhaustedError("of another kind")));
  EXPECT_FALSE(retry_after_ms(absl::OkStatus()));
}

}  // namespace
}  // namespace isofield::rpc
