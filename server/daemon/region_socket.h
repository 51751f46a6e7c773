// The unix socket by which clients of the same user share memory with the daemon; shared_memory.proto describes the
// protocol.
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

// Returns the path of that socket, which lies beside config.listen, or "" if no memory is shared. The path is absolute,
// since clients may run in other folders.
std::string region_socket_path(const Config& config);

// Owns a file descriptor and closes it at the end; a negative number is no descriptor.
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

// Accepts connections and opens a region of `regions` for each; the region is closed with its connection. It serves on
// a thread of its own from its creation to its destruction, which removes the socket's file. `regions` must outlive it.
class RegionSocket {
 public:
  // Listens at `path`; a socket that is there already, such as one of a dead process, is replaced. At most
  // `max_connections` are open at once. INVALID_ARGUMENT: the path is too long. UNAVAILABLE: it cannot listen there.
  static absl::StatusOr<std::unique_ptr<RegionSocket>> listen(const std::string& path, rpc::SharedRegions& regions,
                                                              std::size_t max_connections);
  ~RegionSocket();

  const std::string& path() const { return path_; }

 private:
  struct Connection {
    Descriptor socket;
    std::string region;  // the name of its region; empty: it has none yet
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
  // Reads one packet and answers it. Returns false if the connection is over.
  bool read_one(Connection& connection);

  const std::string path_;
  rpc::SharedRegions& regions_;
  const std::size_t max_connections_;
  const Descriptor listener_, stop_;
  std::vector<Connection> connections_;
  std::thread thread_;  // the last member, since the thread uses the others
};

}  // namespace isofield::daemon
