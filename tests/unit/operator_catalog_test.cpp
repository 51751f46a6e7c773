#include "catalog/operator_catalog.h"

#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>
#include <gtest/gtest.h>

#include "blobtree/scene/operator_reader.h"
#include "catalog/built_in_operators.h"
#include "catalog/memory_store.h"

namespace isofield::catalog {
namespace {

v1::Operator bulge(double k) {
  v1::Operator message;
  message.mutable_gradient()->mutable_silhouette()->set_kind(v1::Silhouette::BULGE);
  message.mutable_gradient()->mutable_silhouette()->set_k(k);
  return message;
}

absl::StatusOr<OperatorEntry> put(OperatorCatalog& catalog, const std::string& name, double k) {
  return catalog.put(name, bulge(k), *blobtree::read_operator(bulge(k)));
}

v1::Scene scene_with(const std::vector<std::string>& operators) {
  v1::Scene scene;
  scene.add_nodes()->mutable_sphere()->set_radius(1);
  for (const std::string& name : operators) {
    v1::Node& node = *scene.add_nodes();
    node.set_name(absl::StrCat("uses ", name));
    node.mutable_custom()->set_operator_(name);
  }
  return scene;
}

TEST(OperatorCatalog, KeepsListsAndRemoves) {
  MemoryStore store;
  OperatorCatalog catalog(store, 10);
  ASSERT_TRUE(put(catalog, "b", 0.5).ok());
  const auto first = put(catalog, "a/x-1.y_z", 0.25);
  ASSERT_TRUE(first.ok()) << first.status();
  EXPECT_EQ(first->version, 2u);
  EXPECT_EQ(catalog.size().value(), 2u);
  EXPECT_EQ(catalog.list("", 10)->front().name, "a/x-1.y_z");
  EXPECT_EQ(catalog.get("b")->message->gradient().silhouette().k(), 0.5);
  const auto second = put(catalog, "b", 0.75);
  EXPECT_EQ(second->version, 3u);
  EXPECT_EQ(catalog.get("b")->op->as<operators::Gradient>()->silhouette.k, 0.75);
  EXPECT_TRUE(catalog.remove("b").ok());
  EXPECT_EQ(catalog.remove("b").code(), absl::StatusCode::kNotFound);
  EXPECT_EQ(put(catalog, "b", 0.5)->version, 4u) << "versions are not used again";
}

TEST(OperatorCatalog, EntriesOutliveTheirNames) {
  MemoryStore store;
  OperatorCatalog catalog(store, 10);
  ASSERT_TRUE(put(catalog, "a", 0.25).ok());
  const OperatorEntry entry = *catalog.get("a");
  ASSERT_TRUE(put(catalog, "a", 0.5).ok());
  ASSERT_TRUE(catalog.remove("a").ok());
  EXPECT_EQ(entry.message->gradient().silhouette().k(), 0.25);
  EXPECT_EQ(entry.op->as<operators::Gradient>()->silhouette.k, 0.25);
}

TEST(OperatorCatalog, RefusesNames) {
  MemoryStore store;
  OperatorCatalog catalog(store, 10);
  for (const std::string& name : {std::string(), std::string("a b"), std::string(129, 'x')}) {
    const absl::Status status = put(catalog, name, 0.5).status();
    EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
    EXPECT_TRUE(absl::StrContains(status.message(), "A-Z a-z 0-9 _ - . /")) << status;
  }
  for (const std::string& name : built_in_names()) {
    const absl::Status status = put(catalog, name, 0.5).status();
    EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
    EXPECT_TRUE(absl::StrContains(status.message(), "built-in")) << status;
  }
  EXPECT_TRUE(put(catalog, "description", 0.5).ok()) << "a field of Operator that is no kind";
}

TEST(OperatorCatalog, RefusesMoreThanAdmitted) {
  MemoryStore store;
  OperatorCatalog catalog(store, 2);
  ASSERT_TRUE(put(catalog, "a", 0.5).ok());
  ASSERT_TRUE(put(catalog, "b", 0.5).ok());
  EXPECT_EQ(put(catalog, "c", 0.5).status().code(), absl::StatusCode::kResourceExhausted);
  EXPECT_TRUE(put(catalog, "b", 0.25).ok()) << "replacing needs no more room";
  ASSERT_TRUE(catalog.remove("a").ok());
  EXPECT_TRUE(put(catalog, "c", 0.5).ok());
}

TEST(OperatorCatalog, NotFoundNamesWhatThereIs) {
  MemoryStore store;
  OperatorCatalog catalog(store, 10);
  EXPECT_TRUE(absl::StrContains(catalog.get("a").status().message(), "gradient"));
  ASSERT_TRUE(put(catalog, "fold", 0.5).ok());
  EXPECT_TRUE(absl::StrContains(catalog.get("a").status().message(), "'fold'"));
  EXPECT_TRUE(absl::StrContains(catalog.remove("gradient").message(), "built-in"));
}

TEST(OperatorCatalog, OperatorsOfASceneAreWhatTheNamesMeanNow) {
  MemoryStore store;
  OperatorCatalog catalog(store, 10);
  ASSERT_TRUE(put(catalog, "a", 0.25).ok());
  ASSERT_TRUE(put(catalog, "b", 0.5).ok());
  EXPECT_TRUE((*catalog.operators_of(scene_with({})))->table.empty());
  const auto operators = *catalog.operators_of(scene_with({"a", "a"}));
  ASSERT_TRUE(put(catalog, "a", 0.75).ok());
  ASSERT_EQ(operators->table.size(), 1u);
  EXPECT_EQ(operators->table.at("a")->as<operators::Gradient>()->silhouette.k, 0.25);
  EXPECT_EQ(operators->messages.at("a")->gradient().silhouette().k(), 0.25);
  const absl::Status status = catalog.operators_of(scene_with({"b", "c"})).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  for (const char* part : {"nodes[2] 'uses c'.operator = 'c'", "'a', 'b'"}) {
    EXPECT_TRUE(absl::StrContains(status.message(), part)) << status;
  }
}

TEST(OperatorCatalog, ReadsWhatItHasSerialized) {
  MemoryStore store;
  OperatorCatalog catalog(store, 10);
  ASSERT_TRUE(put(catalog, "a", 0.25).ok());
  const std::vector<std::string> names{"a"};
  const auto kept = *store.get(Kind::kOperator, names);
  const auto value = OperatorCatalog::parse(kept[0]->value->serialized());
  ASSERT_TRUE(value.ok()) << value.status();
  ASSERT_TRUE(store.put(Kind::kOperator, "b", *value, {}, {}).ok());
  EXPECT_EQ(catalog.get("b")->message->gradient().silhouette().k(), 0.25);
  EXPECT_EQ(catalog.get("b")->op->as<operators::Gradient>()->silhouette.k, 0.25);
  EXPECT_EQ(OperatorCatalog::parse("\xff").status().code(), absl::StatusCode::kDataLoss);
}

TEST(BuiltInOperators, AreTheKindsOfTheContract) {
  EXPECT_EQ(built_in_names().front(), "sum");
  EXPECT_EQ(built_in_names().back(), "sampled");
  for (const std::string& name : built_in_names()) EXPECT_EQ(kind_name(*built_in_operator(name)), name);
  EXPECT_FALSE(built_in_operator("description"));
  EXPECT_FALSE(built_in_operator(""));
  EXPECT_EQ(kind_name(v1::Operator()), "");
}

}  // namespace
}  // namespace isofield::catalog
