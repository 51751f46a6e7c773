// Tests scenes that were damaged at random. They are accepted or refused, never crash the daemon, and are finite if
// accepted.
#include <google/protobuf/stubs/logging.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <limits>

#include "integration/daemon.h"
#include "integration/peer.h"
#include "support/random_scene.h"

namespace isofield::integration_test {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using grpc::StatusCode;
using test_support::Random;

double odd_number(Random& random) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  static const double kOdd[] = {0,      -0.0, 1,           -1,   0.5,  1e-9,      1e-10,      1e-300,
                                5e-324, 1e9,  1.0000001e9, 1e19, 1e39, 1e300,     45,         90,
                                180,    64,   1e-5,        -1e9, 360,  kInfinity, -kInfinity, std::nan("")};
  return random.chance(0.5) ? kOdd[random.integer(0, std::size(kOdd) - 1)] : random.number(-3, 3);
}

std::string odd_reference(Random& random) {
  static const char* const kOdd[] = {"", "#", "#-1", "#0", "#1", "#99999999999", "#0x1", "a.b", "none", "# 1"};
  return kOdd[random.integer(0, std::size(kOdd) - 1)];
}

// Changes one thing in the message, or below it.
void damage(Message& message, Random& random) {
  const auto* reflection = message.GetReflection();
  std::vector<const FieldDescriptor*> set;
  reflection->ListFields(message, &set);
  if (set.empty()) return;
  const FieldDescriptor* const field = set[random.integer(0, static_cast<int>(set.size()) - 1)];
  const int last = field->is_repeated() ? reflection->FieldSize(message, field) - 1 : 0;
  const int at = random.integer(0, last);
  if (random.chance(0.05)) return reflection->ClearField(&message, field);
  if (field->is_repeated() && random.chance(0.1)) return reflection->RemoveLast(&message, field);
  switch (field->cpp_type()) {
    case FieldDescriptor::CPPTYPE_MESSAGE:
      damage(field->is_repeated() ? *reflection->MutableRepeatedMessage(&message, field, at)
                                  : *reflection->MutableMessage(&message, field),
             random);
      break;
    case FieldDescriptor::CPPTYPE_DOUBLE:
      if (!field->is_repeated()) {
        reflection->SetDouble(&message, field, odd_number(random));
      } else if (random.chance(0.1)) {
        reflection->AddDouble(&message, field, odd_number(random));
      } else {
        reflection->SetRepeatedDouble(&message, field, at, odd_number(random));
      }
      break;
    case FieldDescriptor::CPPTYPE_STRING:
      if (!field->is_repeated()) {
        reflection->SetString(&message, field, odd_reference(random));
      } else if (random.chance(0.3)) {
        reflection->AddString(&message, field, odd_reference(random));
      } else {
        reflection->SetRepeatedString(&message, field, at, odd_reference(random));
      }
      break;
    case FieldDescriptor::CPPTYPE_ENUM:
      reflection->SetEnumValue(&message, field, random.integer(-1, 5));
      break;
    case FieldDescriptor::CPPTYPE_BOOL:
      reflection->SetBool(&message, field, random.chance(0.5));
      break;
    default:
      break;
  }
}

// Half of the scenes hold every kind of operator that random scenes have.
v1::Scene seed_scene(int i) {
  return test_support::random_scene(i, {.nodes = i % 2 ? 45 : 12});
}

class Fuzz : public testing::Test {
 protected:
  // Puts the scene, and evaluates it if it is accepted.
  void offer(const v1::Scene& scene, Random& random) {
    const grpc::Status status = peer_.put("fuzz", scene);
    if (!status.ok()) {
      ASSERT_EQ(status.error_code(), StatusCode::INVALID_ARGUMENT) << status.error_message();
      ASSERT_FALSE(status.error_message().empty());
      ++refused_;
      return;
    }
    ++accepted_;
    std::vector<float> xyz, results;
    for (int i = 0; i < 3 * 24; ++i) {
      const double reach = i < 48 ? 2.5 : i < 60 ? 1e9 : 3e38;
      xyz.push_back(static_cast<float>(random.number(-reach, reach)));
    }
    ASSERT_TRUE(ok(peer_.evaluate(named("fuzz"), xyz, true, &results))) << scene.DebugString();
    for (const float v : results) ASSERT_TRUE(std::isfinite(v)) << scene.DebugString();
  }
  void TearDown() override {
    peer_.remove("fuzz");
    std::cout << accepted_ << " scenes accepted, " << refused_ << " refused\n";
    EXPECT_GT(accepted_, 100);
    EXPECT_GT(refused_, 100);
    EXPECT_TRUE(shared_daemon().is_running());
    expect_serving(shared_daemon().address());
  }

  // There are few scenes, because every new set of operators is a kernel to compile.
  static constexpr int kScenes = 6;

  Peer peer_{shared_daemon().address()};
  int accepted_ = 0, refused_ = 0;
};

TEST_F(Fuzz, DamagedFieldsAreAcceptedOrRefused) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    SCOPED_TRACE(i);
    v1::Scene scene = seed_scene(i % kScenes);
    for (int times = random.integer(1, 3); times > 0; --times) damage(scene, random);
    offer(scene, random);
    if (HasFatalFailure()) break;
  }
}

TEST_F(Fuzz, DamagedBytesAreAcceptedOrRefused) {
  Random random(2);
  for (int i = 0; i < 1000;) {
    SCOPED_TRACE(i);
    std::string bytes = seed_scene(i % kScenes).SerializeAsString();
    const int last = static_cast<int>(bytes.size()) - 1;
    if (random.chance(0.2)) bytes.resize(random.integer(0, last));
    for (int times = random.integer(0, 3); times > 0 && !bytes.empty(); --times) {
      bytes[random.integer(0, static_cast<int>(bytes.size()) - 1)] = static_cast<char>(random.integer(0, 255));
    }
    v1::Scene scene;
    const google::protobuf::LogSilencer not_a_line_each;
    if (!scene.ParsePartialFromString(bytes)) continue;  // gRPC itself refuses those
    ++i;
    offer(scene, random);
    if (HasFatalFailure()) break;
  }
}

}  // namespace
}  // namespace isofield::integration_test
