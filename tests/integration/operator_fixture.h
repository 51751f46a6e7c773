// A test fixture with the calls to the operator service of the shared daemon.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "integration/daemon.h"
#include "integration/peer.h"

namespace isofield::integration_test {

// Returns a contact blend with a bulge of this strength.
inline v1::Operator bulge(double k) {
  v1::Operator message;
  message.mutable_gradient()->mutable_opening()->set_preset(v1::Opening::CONTACT);
  message.mutable_gradient()->mutable_silhouette()->set_kind(v1::Silhouette::BULGE);
  message.mutable_gradient()->mutable_silhouette()->set_k(k);
  return message;
}

class OperatorFixture : public testing::Test {
 protected:
  // Removes all scenes and custom operators, so that the next test finds empty catalogs.
  void TearDown() override {
    for (const v1::SceneSummary& summary : peer_.list()) EXPECT_TRUE(ok(peer_.remove(summary.name())));
    for (const v1::OperatorSummary& summary : list()) {
      if (summary.version() != 0) {
        EXPECT_TRUE(ok(remove(summary.name())));
      }
    }
    EXPECT_TRUE(shared_daemon().is_running());
  }

  grpc::Status put(const std::string& name, const v1::Operator& message, v1::OperatorSummary* summary = nullptr) {
    return put(peer_, name, message, summary);
  }
  static grpc::Status put(Peer& peer, const std::string& name, const v1::Operator& message,
                          v1::OperatorSummary* summary = nullptr) {
    LimitedContext context;
    v1::PutOperatorRequest request;
    request.set_name(name);
    *request.mutable_operator_() = message;
    v1::PutOperatorResponse response;
    const grpc::Status status = peer.operators().PutOperator(&context, request, &response);
    if (summary) *summary = response.summary();
    return status;
  }
  grpc::Status get(const std::string& name, v1::GetOperatorResponse* response) {
    LimitedContext context;
    v1::GetOperatorRequest request;
    request.set_name(name);
    return peer_.operators().GetOperator(&context, request, response);
  }
  grpc::Status remove(const std::string& name) {
    LimitedContext context;
    v1::DeleteOperatorRequest request;
    request.set_name(name);
    v1::DeleteOperatorResponse response;
    return peer_.operators().DeleteOperator(&context, request, &response);
  }
  std::vector<v1::OperatorSummary> list() {
    LimitedContext context;
    v1::ListOperatorsResponse response;
    EXPECT_TRUE(ok(peer_.operators().ListOperators(&context, {}, &response)));
    return {response.operators().begin(), response.operators().end()};
  }

  static v1::EvaluateOperatorRequest request(const v1::Operator& message, const std::vector<std::string>& columns,
                                             const std::vector<float>& numbers) {
    v1::EvaluateOperatorRequest request;
    *request.mutable_inline_() = message;
    set_rows(columns, numbers, request);
    return request;
  }
  static void set_rows(const std::vector<std::string>& columns, const std::vector<float>& numbers,
                       v1::EvaluateOperatorRequest& request) {
    request.mutable_columns()->Assign(columns.begin(), columns.end());
    v1::Tensor& tensor = *request.mutable_arguments();
    tensor.set_dtype(v1::Tensor::FLOAT32);
    tensor.clear_shape();
    tensor.add_shape(columns.empty() ? 0 : numbers.size() / columns.size());
    tensor.add_shape(columns.size());
    tensor.set_data(numbers.data(), numbers.size() * sizeof(float));
  }
  grpc::Status evaluate(const v1::EvaluateOperatorRequest& request, v1::EvaluateOperatorResponse* response = nullptr) {
    LimitedContext context;
    v1::EvaluateOperatorResponse ignored;
    return peer_.operators().EvaluateOperator(&context, request, response ? response : &ignored);
  }
  grpc::Status pick(const v1::SceneRef& scene, const std::string& node, const std::vector<double>& point,
                    v1::PickOpeningResponse* response) {
    LimitedContext context;
    v1::PickOpeningRequest request;
    *request.mutable_scene() = scene;
    request.set_node(node);
    request.mutable_point()->Assign(point.begin(), point.end());
    return peer_.operators().PickOpening(&context, request, response);
  }
  std::vector<float> values(const v1::SceneRef& scene) {
    std::vector<float> xyz, results;
    for (int i = 0; i < 900; ++i) xyz.push_back(static_cast<float>((i * 7919 % 200) - 100) / 80);
    EXPECT_TRUE(ok(peer_.evaluate(scene, xyz, true, &results)));
    return results;
  }

  Peer peer_{shared_daemon().address()};
};

}  // namespace isofield::integration_test
