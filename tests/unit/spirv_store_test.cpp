#include "engine/kernels/spirv_store.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <numeric>
#include <string>

#include "support/temporary_folder.h"

namespace isofield::engine {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::uint32_t>;

std::vector<fs::path> files_of(const test_support::TemporaryFolder& folder) {
  std::vector<fs::path> files;
  for (const auto& file : fs::directory_iterator(folder.path())) files.push_back(file.path());
  return files;
}

std::string content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void write(const fs::path& path, const std::string& content) {
  std::ofstream(path, std::ios::binary) << content;
}

// Makes all files look as if they had last been used so many hours earlier.
void age(const test_support::TemporaryFolder& folder, int hours) {
  for (const fs::path& file : files_of(folder)) {
    fs::last_write_time(file, fs::last_write_time(file) - std::chrono::hours(hours));
  }
}

TEST(SpirvStore, WhatIsKeptComesBackToTheBit) {
  const test_support::TemporaryFolder folder;
  const std::string with_zero("void main() {}\n\0\xff", 17);
  Words words(1000);
  std::iota(words.begin(), words.end(), 0xfffffe00u);
  {
    const SpirvStore store(folder.path() + "/made/when/needed");
    EXPECT_FALSE(store.load(with_zero));
    store.save(with_zero, words);
    store.save("another", {7});
  }
  const SpirvStore store(folder.path() + "/made/when/needed");
  EXPECT_EQ(store.load(with_zero), words);
  EXPECT_EQ(store.load("another"), Words{7});
  EXPECT_FALSE(store.load(with_zero.substr(0, 16)));
  store.save("another", {8, 9});
  EXPECT_EQ(store.load("another"), (Words{8, 9}));
}

TEST(SpirvStore, AFileThatIsDamagedOrOfAnotherTextIsNotUsed) {
  const test_support::TemporaryFolder folder;
  const SpirvStore store(folder.path());
  const Words words{1, 2, 3, 4};
  store.save("text", words);
  ASSERT_EQ(files_of(folder).size(), 1u);
  const fs::path path = files_of(folder)[0];
  const std::string whole = content_of(path);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string changed = whole;
    changed[i] = static_cast<char>(changed[i] ^ 1);
    write(path, changed);
    EXPECT_FALSE(store.load("text")) << "byte " << i << " has changed";
    write(path, whole.substr(0, i));
    EXPECT_FALSE(store.load("text")) << "cut to " << i << " bytes";
  }
  write(path, whole + std::string(4, '\0'));
  EXPECT_FALSE(store.load("text"));

  // The file of another text stands under this text's name, as if both had the same hash.
  fs::remove(path);
  store.save("mask", words);
  fs::rename(files_of(folder)[0], path);
  EXPECT_FALSE(store.load("text"));

  store.save("text", words);
  EXPECT_EQ(store.load("text"), words);
}

TEST(SpirvStore, KeepsWhatWasUsedLast) {
  const test_support::TemporaryFolder folder;
  const Words kernel(1000);
  const auto is_there = [&](const SpirvStore& store, const char* text) { return store.load(text).has_value(); };
  {
    const SpirvStore store(folder.path(), 1 << 20);
    for (const char* text : {"first", "second", "third"}) {
      store.save(text, kernel);
      age(folder, 1);
    }
    EXPECT_TRUE(is_there(store, "first"));  // and so used last
  }
  const SpirvStore small(folder.path(), 9000);  // holds two
  EXPECT_TRUE(is_there(small, "first"));
  EXPECT_FALSE(is_there(small, "second"));
  EXPECT_TRUE(is_there(small, "third"));
  small.save("fourth", kernel);  // more than a sixteenth: one goes at once
  EXPECT_TRUE(is_there(small, "fourth"));
  EXPECT_EQ(is_there(small, "first") + is_there(small, "third"), 1);
}

TEST(SpirvStore, HalfWrittenFilesCountAndFilesOfOthersStay) {
  const test_support::TemporaryFolder folder;
  write(folder.path() + "/0123456789abcdef.spv.77.1", std::string(9000, 'x'));
  write(folder.path() + "/notes.txt", std::string(9000, 'x'));
  age(folder, 1);
  { const SpirvStore roomy(folder.path(), 9000); }
  EXPECT_EQ(files_of(folder).size(), 2u);
  const SpirvStore small(folder.path(), 8999);
  ASSERT_EQ(files_of(folder).size(), 1u);
  EXPECT_EQ(files_of(folder)[0].filename(), "notes.txt");
  small.save("text", {1, 2, 3});
  EXPECT_EQ(files_of(folder).size(), 2u) << "a save leaves one file";
}

TEST(SpirvStore, WithoutAFolderThatCanBeWrittenNothingIsKept) {
  const test_support::TemporaryFolder folder;
  write(folder.path() + "/file", "");
  for (const std::string& path : {std::string(), folder.path() + "/file/within"}) {
    const SpirvStore store(path);
    store.save("text", {1, 2, 3});
    EXPECT_FALSE(store.load("text"));
  }
  EXPECT_EQ(files_of(folder).size(), 1u);
}

// Two processes save the same text over and over, each time as other words, while this one reads it.
TEST(SpirvStore, ProcessesThatShareAFolderSeeWholeFiles) {
  constexpr std::size_t kWords = 10'000;
  constexpr std::uint32_t kSaves = 100;
  const test_support::TemporaryFolder folder;
  const SpirvStore store(folder.path());
  store.save("text", Words(kWords, 0));
  std::vector<pid_t> writers;
  for (const std::uint32_t process : {1u, 2u}) {
    const pid_t writer = fork();
    ASSERT_GE(writer, 0);
    if (writer == 0) {
      for (std::uint32_t n = 0; n < kSaves; ++n) store.save("text", Words(kWords, kSaves * process + n));
      _exit(0);
    }
    writers.push_back(writer);
  }
  std::size_t missing = 0, mixed = 0;
  while (!writers.empty()) {
    const std::optional<Words> words = store.load("text");
    missing += !words;
    mixed += words && (words->size() != kWords || std::count(words->begin(), words->end(), words->front()) != kWords);
    int status = 0;
    const pid_t ended = waitpid(writers.back(), &status, WNOHANG);
    ASSERT_GE(ended, 0);
    if (ended == 0) continue;
    EXPECT_EQ(status, 0);
    writers.pop_back();
  }
  EXPECT_EQ(missing, 0u);
  EXPECT_EQ(mixed, 0u);
  EXPECT_EQ(files_of(folder).size(), 1u);
}

}  // namespace
}  // namespace isofield::engine
