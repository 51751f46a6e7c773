// Reads edits of a scene's numbers from the messages of a request.
#pragma once

#include <google/protobuf/repeated_ptr_field.h>

#include <vector>

#include "blobtree/scene/parameter_edit.h"
#include "isofield/v1/scene_service.pb.h"

namespace isofield::rpc {

inline std::vector<blobtree::ParameterEdit> read_edits(
    const google::protobuf::RepeatedPtrField<v1::ParameterEdit>& edits) {
  std::vector<blobtree::ParameterEdit> read;
  for (const v1::ParameterEdit& e : edits) {
    read.push_back({e.node(), e.field(), {e.values().begin(), e.values().end()}});
  }
  return read;
}

}  // namespace isofield::rpc
