// Tests that texts from clients appear in errors as readable, short texts that are valid in a status.
#include "base/quoted.h"

#include <gtest/gtest.h>

#include "rpc/status.h"

namespace isofield {
namespace {

using base::printable;

TEST(Quoted, PlainTextStaysAsItIs) {
  EXPECT_EQ(base::quoted(""), "''");
  EXPECT_EQ(base::quoted("arm/upper 'left' \\ %"), "'arm/upper 'left' \\ %'");
  EXPECT_EQ(base::quoted("Zürich 東京 🐟"), "'Zürich 東京 🐟'");
}

TEST(Quoted, ControlCharactersAreEscaped) {
  EXPECT_EQ(base::quoted("a\nb\r\tc"), "'a\\nb\\r\\tc'");
  EXPECT_EQ(base::quoted(std::string("\0\x1b[31m\x7f", 7)), "'\\x00\\x1b[31m\\x7f'");
  EXPECT_EQ(base::quoted("\xc2\x85 \xe2\x80\xa8"), "'\\xc2\\x85 \\xe2\\x80\\xa8'") << "C1, and the separator of lines";
}

TEST(Quoted, BytesThatAreNoUtf8AreEscaped) {
  for (const auto& [bytes, shown] : {
           std::pair{"\xff", "'\\xff'"},
           {"a\x80z", "'a\\x80z'"},
           {"\xc3", "'\\xc3'"},                            // cut off
           {"\xc3(", "'\\xc3('"},                          // not continued
           {"\xc0\xaf", "'\\xc0\\xaf'"},                   // longer than necessary
           {"\xe0\x80\xaf", "'\\xe0\\x80\\xaf'"},          // longer than necessary
           {"\xed\xa0\x80", "'\\xed\\xa0\\x80'"},          // half of a surrogate pair
           {"\xf4\x90\x80\x80", "'\\xf4\\x90\\x80\\x80'"}  // beyond Unicode
       }) {
    EXPECT_EQ(base::quoted(bytes), shown);
  }
}

TEST(Quoted, LongNamesAreCutAt80Characters) {
  EXPECT_EQ(base::quoted(std::string(80, 'n')), "'" + std::string(80, 'n') + "'");
  EXPECT_EQ(base::quoted(std::string(81, 'n')), "'" + std::string(80, 'n') + "...'");
  EXPECT_EQ(base::quoted(std::string(1 << 20, 'n')), "'" + std::string(80, 'n') + "...'");
  std::string fish, shown;
  for (int i = 0; i < 100; ++i) fish += "🐟";
  for (int i = 0; i < 80; ++i) shown += "🐟";
  EXPECT_EQ(base::quoted(fish), "'" + shown + "...'");
  EXPECT_EQ(printable("abc\n", 4), "abc...") << "an escape is not cut in two";
}

TEST(Quoted, PrefixesEndWithAWholeCharacter) {
  EXPECT_EQ(base::utf8_prefix("abc", 3), "abc");
  EXPECT_EQ(base::utf8_prefix("abcd", 3), "abc");
  EXPECT_EQ(base::utf8_prefix("ab\xc3\xbc", 3), "ab");
  EXPECT_EQ(base::utf8_prefix("🐟🐟", 7), "🐟");
}

// Returns the number of bytes that gRPC makes of a message: a character that is not plain ASCII takes three.
std::size_t header_bytes(const std::string& message) {
  std::size_t bytes = 0;
  for (const unsigned char c : message) bytes += c < 0x20 || c > 0x7e || c == '%' ? 3 : 1;
  return bytes;
}

TEST(Quoted, StatusesFitTheHeadersOfAClient) {
  std::string fish;
  for (int i = 0; i < 10'000; ++i) fish += "🐟";
  for (const std::string& text : {std::string(1 << 20, 'x'), std::string(1 << 20, '\n'), std::string(1 << 20, '\xff'),
                                  std::string(1 << 20, '%'), fish}) {
    const grpc::Status status = rpc::to_grpc(absl::InvalidArgumentError(text));
    EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
    EXPECT_LE(header_bytes(status.error_message()), 7u << 10);
    EXPECT_GE(status.error_message().size(), rpc::kMaxStatusBytes - 4);
    EXPECT_EQ(status.error_message().substr(status.error_message().size() - 3), "...");
  }
  const std::string whole(rpc::kMaxStatusBytes, 'x');
  EXPECT_EQ(rpc::to_grpc(absl::InternalError(whole)).error_message(), whole);
  EXPECT_TRUE(rpc::to_grpc(absl::OkStatus()).ok());
}

}  // namespace
}  // namespace isofield
