#include "points/result_writer.h"

#include <absl/strings/match.h>

#include <charconv>

#include "points/npy_header.h"

namespace isofield {
namespace {

class CsvWriter : public ResultWriter {
 public:
  CsvWriter(bool gradient, OutputFile& file)
      : columns_(gradient ? 4 : 1), file_(file), text_(gradient ? "x,y,z,value,gx,gy,gz\n" : "x,y,z,value\n") {}

  absl::Status write(std::span<const float> xyz, std::span<const float> results) override {
    for (std::size_t point = 0; 3 * point < xyz.size(); ++point) {
      for (std::size_t axis = 0; axis < 3; ++axis) add(xyz[3 * point + axis], ',');
      for (std::size_t column = 0; column < columns_; ++column) {
        add(results[columns_ * point + column], column + 1 < columns_ ? ',' : '\n');
      }
      if (text_.size() < kBlock) continue;
      if (auto status = flush(); !status.ok()) return status;
    }
    return absl::OkStatus();
  }

  absl::Status finish() override { return flush(); }

 private:
  static constexpr std::size_t kBlock = 65536;

  void add(float value, char end) {
    char digits[32];
    const auto last = std::to_chars(digits, digits + sizeof(digits), value, std::chars_format::general, 9).ptr;
    text_.append(digits, last);
    text_.push_back(end);
  }

  absl::Status flush() {
    auto status = file_.write(text_);
    text_.clear();
    return status;
  }

  const std::size_t columns_;
  OutputFile& file_;
  std::string text_;
};

// Writes a NumPy array. The number of rows is known only at the end, so the header is then written again with the same
// length.
class NpyWriter : public ResultWriter {
 public:
  NpyWriter(bool gradient, OutputFile& file) : columns_(gradient ? 4 : 1), file_(file), status_(file.write(header())) {}

  absl::Status write(std::span<const float>, std::span<const float> results) override {
    rows_ += results.size() / columns_;
    status_.Update(file_.write(results.data(), results.size_bytes()));
    return status_;
  }

  absl::Status finish() override {
    const std::string text = header();
    status_.Update(file_.rewrite(0, text.data(), text.size()));
    return status_;
  }

 private:
  std::string header() const { return npy_header(rows_, columns_); }

  const std::size_t columns_;
  OutputFile& file_;
  std::uint64_t rows_ = 0;
  absl::Status status_;
};

}  // namespace

std::unique_ptr<ResultWriter> make_result_writer(const std::string& path, bool gradient, OutputFile& file) {
  if (absl::EndsWithIgnoreCase(path, ".npy")) return std::make_unique<NpyWriter>(gradient, file);
  return std::make_unique<CsvWriter>(gradient, file);
}

}  // namespace isofield
