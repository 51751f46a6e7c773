#include "operators/parameter_ranges.h"

#include <absl/strings/ascii.h>
#include <absl/strings/str_cat.h>
#include <absl/strings/str_join.h>

#include <vector>

#include "isofield/v1/options.pb.h"

namespace isofield {
namespace {

std::string choices(const google::protobuf::EnumDescriptor& type) {
  std::vector<std::string> names;
  for (int i = 0; i < type.value_count(); ++i) {
    if (type.value(i)->number() != 0) names.push_back(absl::AsciiStrToLower(type.value(i)->name()));
  }
  return absl::StrCat("one of ", absl::StrJoin(names, ", "));
}

}  // namespace

ParameterRange range_of(const google::protobuf::FieldDescriptor& field) {
  using google::protobuf::FieldDescriptor;
  ParameterRange range;
  range.accepts = field.options().GetExtension(v1::accepts);
  range.otherwise = field.options().GetExtension(v1::otherwise);
  if (field.name() == "form") range.otherwise = "union";
  if (field.cpp_type() == FieldDescriptor::CPPTYPE_ENUM) range.accepts = choices(*field.enum_type());
  if (field.cpp_type() == FieldDescriptor::CPPTYPE_BOOL) range.accepts = "true or false";
  return range;
}

}  // namespace isofield
