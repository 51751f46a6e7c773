#pragma once

#include <absl/strings/string_view.h>
#include <google/protobuf/descriptor.h>

#include <string>

namespace isofield {

// The first place at which a JSON text does not fit a message. Its text says more than protobuf's own errors do.
struct JsonMisfit {
  enum class Kind {
    kNone,
    // The text is no JSON, or JSON of a looser kind, which protobuf may accept all the same.
    kSyntax,
    // A field does not exist or is stated twice, two fields of one oneof are stated, or a value has the wrong type.
    kMeaning,
  };
  Kind kind = Kind::kNone;
  std::string place;  // line and column, both from 1, such as "12:7"; columns are counted in bytes
  std::string text;   // such as "nodes[2] 'arm'.sphere has no field \"radus\"; did you mean ..."
};

// Checks the names of fields and the types of their values. Ranges of numbers are left to protobuf.
JsonMisfit find_misfit(absl::string_view text, const google::protobuf::Descriptor& type);

}  // namespace isofield
