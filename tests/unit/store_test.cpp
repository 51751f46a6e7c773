// Tests what every store does: conditions, quotas, versions, listing, and that each operation is one step.
#include "catalog/store.h"

#include <absl/strings/str_cat.h>
#include <gtest/gtest.h>

#include <atomic>
#include <barrier>
#include <set>
#include <thread>

#include "catalog/memory_store.h"

namespace isofield::catalog {
namespace {

using Outcome = Store::Put::Outcome;

class Text final : public Value {
 public:
  explicit Text(std::string text) : text_(std::move(text)) {}
  std::string serialized() const override { return text_; }
  std::uint64_t bytes() const override { return text_.size(); }

 private:
  const std::string text_;
};

// Each implementation of Store runs these tests.
template <class Implementation>
class StoreTest : public testing::Test {
 protected:
  Store::Put put(const std::string& name, const std::string& text, const Condition& condition = {},
                 const Quota& quota = {}, Kind kind = Kind::kScene) {
    return store_.put(kind, name, std::make_shared<const Text>(text), condition, quota).value();
  }
  // Returns "text of version v", or an empty text if there is no such record.
  std::string at(const std::string& name, Kind kind = Kind::kScene) {
    const std::optional<Record> record = store_.get(kind, std::span(&name, 1)).value().front();
    return record ? absl::StrCat(record->value->serialized(), " of version ", record->version) : "";
  }
  std::string names_after(const std::string& after, std::size_t most) {
    const std::vector<Record> records = store_.list(Kind::kScene, after, most).value();
    std::string names;
    for (const Record& record : records) names += record.name + " ";
    return names;
  }

  Implementation store_;
};

using Implementations = testing::Types<MemoryStore>;
TYPED_TEST_SUITE(StoreTest, Implementations);

TYPED_TEST(StoreTest, KeepsTheLastValueOfAName) {
  EXPECT_EQ(this->at("a"), "");
  const Store::Put first = this->put("a", "one");
  EXPECT_EQ(first.outcome, Outcome::kDone);
  EXPECT_EQ(first.version, 1u);
  EXPECT_EQ(first.found, 0u);
  const Store::Put second = this->put("a", "two");
  EXPECT_EQ(second.version, 2u);
  EXPECT_EQ(second.found, 1u);
  EXPECT_EQ(this->at("a"), "two of version 2");
}

TYPED_TEST(StoreTest, KindsAreApart) {
  this->put("a", "scene");
  EXPECT_EQ(this->put("a", "operator", {.must_be_absent = true}, {}, Kind::kOperator).version, 1u);
  EXPECT_EQ(this->at("a"), "scene of version 1");
  EXPECT_EQ(this->at("a", Kind::kOperator), "operator of version 1");
  EXPECT_EQ(this->store_.usage(Kind::kScene)->entries, 1u);
}

TYPED_TEST(StoreTest, NeverUsesAVersionAgain) {
  this->put("a", "one");
  this->put("b", "two");
  EXPECT_EQ(this->store_.remove(Kind::kScene, "b").value()->version, 2u);
  EXPECT_FALSE(this->store_.remove(Kind::kScene, "b").value());
  EXPECT_EQ(this->put("b", "three").version, 3u);
}

TYPED_TEST(StoreTest, PutsOnlyWhereTheConditionHolds) {
  EXPECT_EQ(this->put("a", "one", {.version = 1}).outcome, Outcome::kIsNotThere);
  EXPECT_EQ(this->put("a", "one", {.must_be_absent = true}).outcome, Outcome::kDone);
  const Store::Put again = this->put("a", "two", {.must_be_absent = true});
  EXPECT_EQ(again.outcome, Outcome::kIsThere);
  EXPECT_EQ(again.found, 1u);
  const Store::Put late = this->put("a", "two", {.version = 7});
  EXPECT_EQ(late.outcome, Outcome::kIsAtAnother);
  EXPECT_EQ(late.found, 1u);
  EXPECT_EQ(this->at("a"), "one of version 1");
  EXPECT_EQ(this->put("a", "two", {.version = 1}).version, 2u) << "a put in vain takes no version";
}

TYPED_TEST(StoreTest, KeepsTheQuota) {
  const Quota quota{.entries = 2, .bytes = 10};
  this->put("a", "123456");
  const Store::Put large = this->put("b", "12345", {}, quota);
  EXPECT_EQ(large.outcome, Outcome::kTooManyBytes);
  EXPECT_EQ(large.amount, 11u);
  EXPECT_EQ(this->put("b", "1234", {}, quota).outcome, Outcome::kDone);
  const Store::Put third = this->put("c", "", {}, quota);
  EXPECT_EQ(third.outcome, Outcome::kTooManyEntries);
  EXPECT_EQ(third.amount, 2u);
  EXPECT_EQ(this->put("a", "1", {}, quota).outcome, Outcome::kDone) << "what is replaced does not count";
  EXPECT_EQ(this->store_.usage(Kind::kScene)->bytes, 5u);
  this->store_.remove(Kind::kScene, "b").value();
  EXPECT_EQ(this->store_.usage(Kind::kScene)->entries, 1u);
  EXPECT_EQ(this->store_.usage(Kind::kScene)->bytes, 1u);
}

TYPED_TEST(StoreTest, ListsByPages) {
  for (const char* name : {"c", "a", "b/x", "B"}) this->put(name, "text");
  EXPECT_EQ(this->names_after("", 10), "B a b/x c ");
  EXPECT_EQ(this->names_after("", 2), "B a ");
  EXPECT_EQ(this->names_after("a", 2), "b/x c ");
  EXPECT_EQ(this->names_after("b", 1), "b/x ") << "no such name";
  EXPECT_EQ(this->names_after("c", 2), "");
}

TYPED_TEST(StoreTest, GetsSeveralNamesAtOneMoment) {
  std::atomic<bool> is_over = false;
  this->put("a", "0");
  this->put("b", "0");
  // The writer always puts "a" before "b".
  std::thread writer([&] {
    for (int i = 1; i <= 2000; ++i) {
      this->put("a", std::to_string(i));
      this->put("b", std::to_string(i));
    }
    is_over = true;
  });
  const std::vector<std::string> names{"a", "none", "b"};
  while (!is_over) {
    const auto found = this->store_.get(Kind::kScene, names).value();
    EXPECT_FALSE(found[1]);
    const int a = std::stoi(found[0]->value->serialized()), b = std::stoi(found[2]->value->serialized());
    EXPECT_TRUE(a == b || a == b + 1) << a << " and " << b;
  }
  writer.join();
}

TYPED_TEST(StoreTest, OfManyConditionalPutsOneIsDone) {
  this->put("a", "0");
  std::atomic<int> done = 0;
  std::barrier all_have_tried(4);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&] {
      for (std::uint64_t version = 1; version < 200; ++version) {
        // The first thread puts the next version.
        if (this->put("a", "x", {.version = version}).outcome == Outcome::kDone) ++done;
        all_have_tried.arrive_and_wait();
        const std::string name = "a";
        EXPECT_GT(this->store_.get(Kind::kScene, std::span(&name, 1)).value().front()->version, version);
      }
    });
  }
  for (std::thread& t : threads) t.join();
  EXPECT_EQ(done, 199);
}

}  // namespace
}  // namespace isofield::catalog
