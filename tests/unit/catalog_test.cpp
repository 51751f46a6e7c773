#include "catalog/catalog.h"

#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>
#include <gtest/gtest.h>

#include <vector>

#include "blobtree/scene/operator_reader.h"
#include "catalog/memory_store.h"
#include "catalog/operator_catalog.h"
#include "catalog/pages.h"

namespace isofield::catalog {
namespace {

using absl::StatusCode;

v1::Scene ball(double radius) {
  v1::Scene scene;
  scene.add_nodes()->mutable_sphere()->set_radius(radius);
  return scene;
}

class CatalogTest : public testing::Test {
 protected:
  absl::StatusOr<Catalog::Put> put(const std::string& name, double radius, const Condition& condition = {}) {
    return catalog_.put(name, ball(radius), std::make_shared<const SceneOperators>(), condition);
  }
  void expect_refused(const absl::Status& status, StatusCode code, const std::vector<std::string>& parts) {
    EXPECT_EQ(status.code(), code) << status;
    for (const std::string& part : parts) EXPECT_TRUE(absl::StrContains(status.message(), part)) << status;
  }

  MemoryStore store_;
  Catalog catalog_{store_, 30};
};

TEST_F(CatalogTest, TellsWhatWasReplacedAndRemoved) {
  EXPECT_EQ(put("a", 1)->replaced_version, 0u);
  const auto second = put("a", 2);
  EXPECT_EQ(second->replaced_version, 1u);
  EXPECT_EQ(second->entry.version, 2u);
  EXPECT_EQ(second->entry.scene->nodes(0).sphere().radius(), 2);
  EXPECT_TRUE(catalog_.get("a")->scene == second->entry.scene) << "not a copy";
  EXPECT_EQ(catalog_.remove("a").value(), 2u);
}

TEST_F(CatalogTest, RefusesInWords) {
  expect_refused(catalog_.get("a").status(), StatusCode::kNotFound, {"no scene is named 'a'", "the catalog is empty"});
  ASSERT_TRUE(put("a", 1).ok());
  expect_refused(put("a b", 1).status(), StatusCode::kInvalidArgument, {"name = 'a b'", "A-Z a-z 0-9 _ - . /"});
  expect_refused(put("a", 1, {.must_be_absent = true}).status(), StatusCode::kAlreadyExists,
                 {"scene 'a' exists already, at version 1"});
  expect_refused(put("a", 1, {.version = 7}).status(), StatusCode::kAborted,
                 {"scene 'a' is at version 1, not at 7; read it again"});
  const std::vector<std::string> not_found{"no scene is named 'b'", "there are 'a'"};
  expect_refused(put("b", 1, {.version = 7}).status(), StatusCode::kNotFound, not_found);
  expect_refused(catalog_.remove("b").status(), StatusCode::kNotFound, not_found);
  for (int i = 1; i < 30; ++i) ASSERT_TRUE(put(absl::StrCat("a", i), 1).ok());
  expect_refused(put("b", 1).status(), StatusCode::kResourceExhausted,
                 {"the catalog holds 30 scenes, all that are admitted; delete one first"});
  expect_refused(catalog_.get("c").status(), StatusCode::kNotFound, {"'a16', 'a17', ..."});
}

TEST_F(CatalogTest, IsListedWithoutALimit) {
  Catalog large(store_, 10'000);
  for (int i = 0; i < 600; ++i) {
    ASSERT_TRUE(large.put(absl::StrCat(1000 + i), ball(1), std::make_shared<const SceneOperators>(), {}).ok());
  }
  std::vector<std::string> names;
  const auto add = [&](const Entry& entry) -> absl::StatusOr<bool> {
    names.push_back(entry.name);
    return names.size() < 580;
  };
  ASSERT_TRUE(for_each_after(large, "1009", add).ok());
  ASSERT_EQ(names.size(), 580u);
  for (int i = 0; i < 580; ++i) EXPECT_EQ(names[i], absl::StrCat(1010 + i));
  EXPECT_EQ(for_each_after(large, "", [](const Entry&) -> absl::StatusOr<bool> { return absl::CancelledError("gone"); })
                .message(),
            "gone");
}

TEST_F(CatalogTest, ReadsWhatItHasSerializedWithTheOperatorsOfThatTime) {
  OperatorCatalog operators(store_, 10);
  v1::Operator bulge;
  bulge.mutable_gradient()->mutable_silhouette()->set_kind(v1::Silhouette::BULGE);
  bulge.mutable_gradient()->mutable_silhouette()->set_k(0.25);
  ASSERT_TRUE(operators.put("bulge", bulge, *blobtree::read_operator(bulge)).ok());
  v1::Scene scene = ball(2);
  scene.add_nodes()->mutable_custom()->set_operator_("bulge");
  ASSERT_TRUE(catalog_.put("a", scene, *operators.operators_of(scene), {}).ok());
  ASSERT_TRUE(operators.remove("bulge").ok());

  const std::vector<std::string> names{"a"};
  const std::string bytes = store_.get(Kind::kScene, names).value()[0]->value->serialized();
  const auto value = Catalog::parse(bytes);
  ASSERT_TRUE(value.ok()) << value.status();
  ASSERT_TRUE(store_.put(Kind::kScene, "b", *value, {}, {}).ok());
  const Entry read = catalog_.get("b").value();
  EXPECT_EQ(read.scene->SerializeAsString(), scene.SerializeAsString());
  EXPECT_EQ(read.operators->table.at("bulge")->as<operators::Gradient>()->silhouette.k, 0.25);
  EXPECT_EQ(read.operators->messages.at("bulge")->SerializeAsString(), bulge.SerializeAsString());
  for (const std::string& broken : {std::string(), bytes.substr(0, 5), bytes.substr(0, bytes.size() - 1)}) {
    EXPECT_EQ(Catalog::parse(broken).status().code(), StatusCode::kDataLoss);
  }
}

}  // namespace
}  // namespace isofield::catalog
