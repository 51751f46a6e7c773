// Clients may send names that nobody would choose. Errors repeat them cut and escaped, so that every status reaches its
// client.
#include <absl/strings/str_cat.h>
#include <gtest/gtest.h>

#include "integration/ball.h"
#include "integration/daemon.h"
#include "integration/peer.h"

namespace isofield::integration_test {
namespace {

using grpc::StatusCode;

const std::string kLong(1 << 20, 'n');
const std::string kCut = absl::StrCat("'", std::string(80, 'n'), "...'");
const std::string kLines = "one\ntwo\x1b[31m\r";
const std::string kEscaped = "'one\\ntwo\\x1b[31m\\r'";

class HostileName : public testing::Test {
 protected:
  // Checks the status, and that its text shows the name in the form `shown`, is short, and has no control characters.
  void expect_shown(const grpc::Status& status, StatusCode code, const std::string& shown) {
    expect_refused(status, code, {shown});
    EXPECT_LE(status.error_message().size(), 2051u);
    for (const char c : status.error_message()) EXPECT_GE(static_cast<unsigned char>(c), 0x20);
  }
  // Sends every kind of request that has a name, with one that does not exist. `shown` is the form in which the status
  // shows it.
  void expect_names_shown(const std::string& name, const std::string& shown) {
    Peer peer(shared_daemon().address(), Peer::Messages::kByDefault);
    const float origin[] = {0, 0, 0};
    const auto context = [this] { return contexts_.emplace_back(std::make_unique<LimitedContext>()).get(); };
    expect_shown(peer.evaluate(named(name), origin, false, nullptr), StatusCode::NOT_FOUND, shown);
    v1::EvaluateStreamRequest first;
    *first.mutable_scene() = named(name);
    expect_shown(peer.evaluate_stream({first}, nullptr), StatusCode::NOT_FOUND, shown);
    ReceivedMesh mesh;
    expect_shown(peer.mesh(mesh_request(named(name), 0.1), &mesh), StatusCode::NOT_FOUND, shown);
    v1::GetSceneResponse scene;
    expect_shown(peer.get(name, &scene), StatusCode::NOT_FOUND, shown);
    expect_shown(peer.remove(name), StatusCode::NOT_FOUND, shown);
    expect_shown(peer.put(name, Ball().scene()), StatusCode::INVALID_ARGUMENT, shown);

    v1::GetOperatorRequest get_operator;
    get_operator.set_name(name);
    v1::GetOperatorResponse got;
    expect_shown(peer.operators().GetOperator(context(), get_operator, &got), StatusCode::NOT_FOUND, shown);
    v1::PutOperatorRequest put_operator;
    put_operator.set_name(name);
    put_operator.mutable_operator_()->mutable_sum();
    v1::PutOperatorResponse put;
    expect_shown(peer.operators().PutOperator(context(), put_operator, &put), StatusCode::INVALID_ARGUMENT, shown);
    v1::PickOpeningRequest pick;
    *pick.mutable_scene() = inlined(Ball().scene());
    pick.set_node(name);
    for (int i = 0; i < 3; ++i) pick.add_point(0);
    v1::PickOpeningResponse picked;
    expect_shown(peer.operators().PickOpening(context(), pick, &picked), StatusCode::INVALID_ARGUMENT, shown);

    // Names within a scene are those of a root, a child, a custom operator, a node and the unit.
    const auto refused = [&](const v1::Scene& scene) {
      expect_shown(peer.evaluate(inlined(scene), origin, false, nullptr), StatusCode::INVALID_ARGUMENT, shown);
    };
    v1::Scene scene_of = Ball().scene();
    scene_of.set_root(name);
    refused(scene_of);
    scene_of = Ball().scene();
    scene_of.add_nodes()->mutable_sum()->add_children(name);
    refused(scene_of);
    scene_of = Ball().scene();
    scene_of.add_nodes()->mutable_custom()->set_operator_(name);
    refused(scene_of);
    scene_of = Ball().scene();
    scene_of.mutable_nodes(0)->set_name(name);
    scene_of.mutable_nodes(0)->mutable_sphere()->set_radius(-1);
    refused(scene_of);

    // An edit's node and field are shown without quotes.
    ASSERT_TRUE(ok(peer.put("edited", Ball().scene())));
    const std::string inner = shown.substr(1, shown.size() - 2);
    v1::EditParametersRequest edit;
    edit.set_name("edited");
    edit.add_edits()->set_node(name);
    expect_shown(peer.edit(edit), StatusCode::INVALID_ARGUMENT, inner);
    edit.mutable_edits(0)->set_node("#0");
    edit.mutable_edits(0)->set_field(name);
    expect_shown(peer.edit(edit), StatusCode::INVALID_ARGUMENT, inner);
    EXPECT_TRUE(ok(peer.remove("edited")));
  }

  std::vector<std::unique_ptr<LimitedContext>> contexts_;
};

TEST_F(HostileName, OfAMegabyteIsCut) {
  expect_names_shown(kLong, kCut);
  expect_serving(shared_daemon().address());
}

TEST_F(HostileName, WithControlCharactersIsEscaped) {
  expect_names_shown(kLines, kEscaped);
}

TEST_F(HostileName, InAWritingOfItsOwnIsKept) {
  expect_names_shown("größe 東京", "'größe 東京'");
}

TEST_F(HostileName, OfANodeIsCutWhereItIsTooLong) {
  Peer peer(shared_daemon().address(), Peer::Messages::kByDefault);
  v1::Scene scene = Ball().scene();
  scene.mutable_nodes(0)->set_name(std::string(100 << 10, 'n'));
  expect_shown(peer.put("named", scene), StatusCode::INVALID_ARGUMENT, kCut);
  expect_refused(peer.put("named", scene), StatusCode::INVALID_ARGUMENT, {"nodes[0]", "at most 256 bytes"});
  scene = Ball().scene();
  scene.set_unit(kLong);
  expect_shown(peer.put("named", scene), StatusCode::INVALID_ARGUMENT, absl::StrCat("unit = ", kCut));
}

TEST_F(HostileName, OfColumnsAreFew) {
  Peer peer(shared_daemon().address(), Peer::Messages::kByDefault);
  v1::EvaluateOperatorRequest request;
  request.set_name("sum");
  for (int i = 0; i < 1000; ++i) request.add_columns(kLines + kLong.substr(0, 1000));
  LimitedContext context;
  v1::EvaluateOperatorResponse response;
  expect_shown(peer.operators().EvaluateOperator(&context, request, &response), StatusCode::INVALID_ARGUMENT,
               "one\\ntwo\\x1b[31m\\r");
}

// Shapes are lists of numbers that the client chose.
TEST_F(HostileName, OrAShapeOfAMillionNumbersIsCut) {
  Peer peer(shared_daemon().address(), Peer::Messages::kByDefault);
  v1::EvaluateRequest request;
  *request.mutable_scene() = inlined(Ball().scene());
  request.mutable_points()->set_dtype(v1::Tensor::FLOAT32);
  request.mutable_points()->mutable_shape()->Resize(1'000'000, ~0ull);
  v1::EvaluateResponse response;
  expect_shown(peer.evaluate(request, &response), StatusCode::INVALID_ARGUMENT, "points.shape = [1844674407");
}

}  // namespace
}  // namespace isofield::integration_test
