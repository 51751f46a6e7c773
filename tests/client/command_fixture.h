// A test fixture that runs the command line tool against a fake server inside the test process.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <string>

#include "fake_server.h"
#include "isofield/scene_file.h"
#include "test_support.h"

namespace isofield {

// Runs the command itself, as a user does. Owns the server and a temporary directory.
class CommandFixture : public ::testing::Test {
 protected:
  // Returns the exit code. Standard output and error go to out_ and err_.
  int run(const std::string& arguments, const std::string& input = "") {
    write_file(path("in"), input);
    const std::string command = std::string(ISOFIELD_COMMAND) + " --server " + address_ + " " + arguments + " <" +
                                path("in") + " >" + path("out") + " 2>" + path("err");
    const int status = std::system(command.c_str());
    out_ = *read_file(path("out"));
    err_ = *read_file(path("err"));
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string path(const std::string& name) const { return directory_.path(name); }

  TemporaryDirectory directory_;
  std::string address_ = "unix:" + path("socket");
  FakeServer server_{address_};
  std::string out_, err_;
};

}  // namespace isofield
