#pragma once

#include <absl/strings/string_view.h>
#include <google/protobuf/descriptor.h>

#include <string>

namespace isofield {

// The first place of a JSON text that does not fit a message, worded better than protobuf does.
struct JsonMisfit {
  enum class Kind {
    kNone,
    // No JSON, or of a looser kind, which protobuf may yet read.
    kSyntax,
    // A field that the message does not have, or that stands there twice; a second kind; a value of another type.
    kMeaning,
  };
  Kind kind = Kind::kNone;
  std::string place;  // "12:7": line and column, from 1; a column is a byte
  std::string text;   // "nodes[2] 'arm'.sphere has no field \"radus\"; did you mean ..."
};

// Looks at names and at what kinds of values they have; numbers and the like are left to protobuf.
JsonMisfit find_misfit(absl::string_view text, const google::protobuf::Descriptor& type);

}  // namespace isofield
