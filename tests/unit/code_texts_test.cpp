#include "generators/code_texts.h"

#include <absl/strings/str_cat.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "blobtree/tape/code_set.h"

namespace isofield::shaders {
namespace {

enum class Many { kFirst = 0, kCount = 200 };

TEST(CodeSet, HoldsTwoHundredKinds) {
  blobtree::CodeSet<Many> set{Many::kFirst, static_cast<Many>(63), static_cast<Many>(199)};
  EXPECT_EQ(set.size(), 3);
  EXPECT_TRUE(set.has(static_cast<Many>(199)));
  EXPECT_FALSE(set.has(static_cast<Many>(198)));
  EXPECT_EQ(set.words()[6], 1u << 199 % 32);
  EXPECT_EQ(blobtree::CodeSet<Many>::kUsedWords, 7u);
  blobtree::CodeSet<Many> other{static_cast<Many>(63)};
  EXPECT_TRUE(set.contains(other));
  other.add(static_cast<Many>(64));
  EXPECT_FALSE(set.contains(other));
  set.remove(static_cast<Many>(63));
  EXPECT_FALSE(set.has(static_cast<Many>(63)));
}

// With two hundred codes of each enum, every code still has a number, a word and a bit of its own.
TEST(CodeTexts, HaveRoomForTwoHundredKinds) {
  std::vector<std::string> names;
  for (int i = 0; i < 200; ++i) names.push_back(absl::StrCat("kind", i));
  std::vector<blobtree::OperandTraits> operands;
  std::vector<operators::OpcodeTraits> opcodes;
  for (const std::string& name : names) {
    operands.push_back({name, name, 2});
    opcodes.push_back({name, name, operators::Applies::kTwo, operators::Seams::kNoSeam, operators::Weight::kIsHeavy});
  }
  const std::string codes = codes_text(operands, opcodes);
  std::set<std::string> tests;
  for (int i = 0; i < 200; ++i) {
    const std::string bit = absl::StrCat(i / 32, " & ", 1u << i % 32, "u) != 0u)");
    const std::string test = absl::StrCat("#define HAS_OPERATOR_KIND", i, " ((OPERATOR_SET_", bit);
    EXPECT_NE(codes.find(test), std::string::npos) << test;
    EXPECT_NE(codes.find(absl::StrCat("const uint OPERAND_KIND", i, " = ", i, "u;")), std::string::npos);
    tests.insert(bit);
  }
  EXPECT_EQ(tests.size(), 200u);
  EXPECT_NE(codes.find("const uint OPERAND_SET_6"), std::string::npos);
  EXPECT_EQ(codes.find("const uint OPERAND_SET_7"), std::string::npos);
  EXPECT_NE(leaves_text(operands).find("v = kind199_field(p, record);"), std::string::npos);
  EXPECT_NE(operators_text(opcodes).find("r = unite_kind199(a, b, record, angle);"), std::string::npos);
}

}  // namespace
}  // namespace isofield::shaders
