#include "gzip.h"

#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>
#include <zlib.h>

#include <algorithm>
#include <limits>
#include <memory>

namespace isofield {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 20;

absl::Status damaged(const char* why) {
  return absl::InvalidArgumentError(absl::StrCat("damaged gzip data: ", why));
}

// Unpacks the first member of `data`, appends it to `unpacked` and removes it from `data`.
absl::Status unpack_member(absl::string_view& data, std::size_t limit, std::string& unpacked) {
  z_stream stream{};
  // Adding 16 makes zlib expect gzip's header and checksum.
  if (inflateInit2(&stream, 16 + MAX_WBITS) != Z_OK) return absl::ResourceExhaustedError("no memory for unpacking");
  const std::unique_ptr<z_stream, int (*)(z_stream*)> end(&stream, &inflateEnd);
  const auto chunk = std::make_unique<char[]>(kChunk);
  int result = Z_OK;
  while (result != Z_STREAM_END) {
    if (stream.avail_in == 0 && !data.empty()) {
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(data.data()));
      stream.avail_in = static_cast<uInt>(std::min<std::size_t>(data.size(), std::numeric_limits<uInt>::max()));
      data.remove_prefix(stream.avail_in);
    }
    stream.next_out = reinterpret_cast<Bytef*>(chunk.get());
    stream.avail_out = kChunk;
    result = inflate(&stream, Z_NO_FLUSH);
    if (result == Z_BUF_ERROR) return damaged("it ends early");
    if (result != Z_OK && result != Z_STREAM_END) return damaged(stream.msg ? stream.msg : "it cannot be unpacked");
    const std::size_t got = kChunk - stream.avail_out;
    if (got > limit - unpacked.size()) {
      return absl::ResourceExhaustedError(absl::StrCat("it holds more than ", limit, " bytes when unpacked"));
    }
    unpacked.append(chunk.get(), got);
  }
  data = {data.data() - stream.avail_in, data.size() + stream.avail_in};
  return absl::OkStatus();
}

}  // namespace

absl::string_view unpacked_name(absl::string_view name) {
  constexpr absl::string_view kEnding = ".gz";
  if (absl::EndsWithIgnoreCase(name, kEnding)) name.remove_suffix(kEnding.size());
  return name;
}

bool is_gzip(absl::string_view data) {
  return absl::StartsWith(data, "\x1f\x8b");
}

absl::StatusOr<std::string> gunzip(absl::string_view data, std::size_t limit) {
  std::string unpacked;
  while (!data.empty()) {
    // Zeros after the last member are padding, which tapes and block devices add.
    if (!is_gzip(data)) {
      if (data.find_first_not_of('\0') == data.npos) break;
      return damaged("other data follows it");
    }
    if (auto status = unpack_member(data, limit, unpacked); !status.ok()) return status;
  }
  return unpacked;
}

}  // namespace isofield
