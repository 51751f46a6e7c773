#include "rpc/shared_regions.h"

#include <absl/strings/escaping.h>
#include <absl/strings/str_cat.h>
#include <fcntl.h>
#include <linux/magic.h>
#include <sys/mman.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <sys/vfs.h>

#include <cerrno>
#include <cstring>

namespace isofield::rpc {
namespace {

// Arrays in a region begin at multiples of this many bytes, which is a multiple of the size of any number and suits the
// host's vector registers.
constexpr std::uint64_t kAlignment = 16;
constexpr std::size_t kNameBytes = 16;

absl::StatusOr<std::uint64_t> size_of(int descriptor) {
  // Only pages of tmpfs are accepted. Others, such as huge pages, may turn out to be missing when they are touched.
  struct statfs system {};
  struct stat file {};
  const int seals = fcntl(descriptor, F_GET_SEALS);
  constexpr int kSize = F_SEAL_SHRINK | F_SEAL_GROW;
  if (seals < 0 || (seals & kSize) != kSize || (seals & F_SEAL_WRITE) != 0 || fstatfs(descriptor, &system) != 0 ||
      system.f_type != TMPFS_MAGIC || fstat(descriptor, &file) != 0) {
    return absl::InvalidArgumentError(
        "expected a memfd with the seals F_SEAL_SHRINK and F_SEAL_GROW, and without F_SEAL_WRITE and huge pages");
  }
  if (file.st_size <= 0) return absl::InvalidArgumentError("the memfd is empty: expected at least a page");
  return static_cast<std::uint64_t>(file.st_size);
}

}  // namespace

struct SharedRegions::Region {
  ~Region() {
    if (data) munmap(data, bytes);
    usage->bytes -= bytes;
    --usage->regions;
  }
  const std::shared_ptr<Usage> usage;
  const std::uint64_t bytes;
  std::byte* data = nullptr;
};

absl::StatusOr<std::string> SharedRegions::open(int descriptor) {
  const absl::StatusOr<std::uint64_t> bytes = size_of(descriptor);
  if (!bytes.ok()) return bytes.status();
  const base::MutexLock lock(mutex_);
  if (usage_->regions >= limits_.max_regions || *bytes > limits_.max_bytes ||
      usage_->bytes > limits_.max_bytes - *bytes) {
    return absl::ResourceExhaustedError(
        absl::StrCat(usage_->regions.load(), " regions with ", usage_->bytes.load(), " bytes are shared, another of ",
                     *bytes, " bytes is too much: ", limits_.max_regions, " with ", limits_.max_bytes,
                     " are admitted (--max-shared-regions, --max-shared-bytes)"));
  }
  ++usage_->regions;
  usage_->bytes += *bytes;
  const std::shared_ptr<Region> region(new Region{usage_, *bytes});
  void* const data = mmap(nullptr, *bytes, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
  if (data == MAP_FAILED) {
    return absl::ResourceExhaustedError(absl::StrCat("cannot map ", *bytes, " bytes: ", std::strerror(errno)));
  }
  region->data = static_cast<std::byte*>(data);
  std::string name(kNameBytes, '\0');
  if (getrandom(name.data(), name.size(), 0) != static_cast<ssize_t>(name.size())) {
    return absl::InternalError(absl::StrCat("no random numbers: ", std::strerror(errno)));
  }
  regions_[name] = region;
  return name;
}

void SharedRegions::close(const std::string& name) {
  std::shared_ptr<Region> last;  // declared before the lock, so that memory is unmapped after the lock is released
  const base::MutexLock lock(mutex_);
  const auto it = regions_.find(name);
  if (it == regions_.end()) return;
  last = std::move(it->second);
  regions_.erase(it);
}

absl::StatusOr<SharedBytes> SharedRegions::find(const v1::SharedTensor& tensor, std::uint64_t count,
                                                std::uint64_t number_bytes, const char* what) const {
  std::shared_ptr<Region> region;
  {
    const base::MutexLock lock(mutex_);
    const auto it = regions_.find(tensor.region());
    if (it != regions_.end()) region = it->second;
  }
  if (!region) {
    return absl::NotFoundError(absl::StrCat(what, ".region = ", absl::BytesToHexString(tensor.region().substr(0, 16)),
                                            ": no such region; its connection may be closed"));
  }
  const std::uint64_t offset = tensor.offset();
  if (offset % kAlignment != 0) {
    return absl::InvalidArgumentError(
        absl::StrCat(what, ".offset = ", offset, ": expected a multiple of ", kAlignment, " bytes"));
  }
  if (offset > region->bytes || count > (region->bytes - offset) / number_bytes) {
    return absl::InvalidArgumentError(absl::StrCat(what, ": ", count, " numbers of ", number_bytes, " bytes from ",
                                                   offset, " on: expected them within the region's ", region->bytes,
                                                   " bytes"));
  }
  return SharedBytes{region, {region->data + offset, count * number_bytes}};
}

}  // namespace isofield::rpc
