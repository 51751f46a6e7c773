// Finds out why a JSON text does not fit a protobuf message.
#pragma once

#include <absl/strings/string_view.h>
#include <google/protobuf/descriptor.h>

#include <string>

namespace isofield {

// The first place at which a JSON text does not fit a message. `text` says more than the errors of protobuf do.
struct JsonMisfit {
  enum class Kind {
    kNone,
    // The text is not JSON, or it is JSON of a looser kind, which protobuf may accept all the same.
    kSyntax,
    // A field does not exist or is stated twice, two fields of one oneof are stated, or a value has the wrong type.
    kMeaning,
  };
  Kind kind = Kind::kNone;
  std::string place;  // line and column, both from 1, such as "12:7"; columns are counted in bytes
  std::string text;   // such as "nodes[2] 'arm'.sphere has no field \"radus\"; did you mean ..."
};

// Checks the names of fields and the types of their values. The ranges of numbers are left to protobuf.
JsonMisfit find_misfit(absl::string_view text, const google::protobuf::Descriptor& type);

}  // namespace isofield
