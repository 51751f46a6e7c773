// The unix socket where clients hand memory over, as shared_memory.proto says.
#pragma once

#include <absl/status/statusor.h>

#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "daemon/config.h"
#include "rpc/shared_regions.h"

namespace isofield::daemon {

// The path of that socket beside config.listen, absolute, since clients may run in other folders; empty where no memory
// is shared.
std::string region_socket_path(const Config& config);

// Owns a file descriptor.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor();
  int get() const { return number_; }
  explicit operator bool() const { return number_ >= 0; }

 private:
  int number_;
};

// Serves on a thread of its own from its creation to its destruction, which removes the socket's file. `regions` must
// outlive it.
class RegionSocket {
 public:
  // At `path`, of which a file that a dead process has left is replaced. INVALID_ARGUMENT: the path is too long.
  // UNAVAILABLE: it cannot listen there.
  static absl::StatusOr<std::unique_ptr<RegionSocket>> listen(const std::string& path, rpc::SharedRegions& regions,
                                                              std::size_t max_connections);
  ~RegionSocket();

  const std::string& path() const { return path_; }

 private:
  struct Connection {
    Descriptor socket;
    std::string region;  // empty: none yet
  };

  RegionSocket(std::string path, rpc::SharedRegions& regions, std::size_t max_connections, Descriptor listener,
               Descriptor stop)
      : path_(std::move(path)),
        regions_(regions),
        max_connections_(max_connections),
        listener_(std::move(listener)),
        stop_(std::move(stop)),
        thread_([this] { serve(); }) {}
  void serve();
  void accept_one();
  // False: it is over.
  bool read_one(Connection& connection);

  const std::string path_;
  rpc::SharedRegions& regions_;
  const std::size_t max_connections_;
  const Descriptor listener_, stop_;
  std::vector<Connection> connections_;
  std::thread thread_;  // last: it uses the others
};

}  // namespace isofield::daemon
