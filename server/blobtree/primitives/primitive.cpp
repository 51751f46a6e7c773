#include "blobtree/primitives/primitive.h"

#include <absl/strings/str_cat.h>

#include <cstdlib>

#include "isofield/v1/scene.pb.h"

namespace isofield::blobtree {
namespace {

// Reads the law of a primitive's field, and its range if it has one.
template <class Message>
void read_law(const Message& m, Primitive& primitive, FieldReader& in) {
  switch (m.law()) {
    case v1::FIELD_LAW_UNSPECIFIED:
    case v1::POSITIVE:
      primitive.range = in.positive("range", m.range());
      return;
    case v1::SIGNED:
      primitive.law = operators::Law::kSigned;
      if (m.range() != 0) in.refuse("range", absl::StrCat(m.range()), "none: a SIGNED field has no range");
      return;
    default:
      in.refuse("law", absl::StrCat(static_cast<int>(m.law())), "POSITIVE or SIGNED");
  }
}

template <class Kind, class Message>
Primitive read(const Message& message, FieldReader& in) {
  Primitive primitive;
  primitive.shape = Kind::read(message, in, primitive.frame);
  read_law(message, primitive, in);
  return primitive;
}

}  // namespace

Primitive read_primitive(const v1::Node& node, FieldReader& in) {
#define ISOFIELD_READ(Name, field) \
  if (node.has_##field()) return read<shapes::Name>(node.field(), in);
  ISOFIELD_PRIMITIVES(ISOFIELD_READ)
#undef ISOFIELD_READ
  std::abort();  // not reached: the caller's switch has kinds of primitives alone
}

}  // namespace isofield::blobtree
