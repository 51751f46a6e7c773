#include "catalog/catalog.h"

#include <absl/strings/str_cat.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>
#include <google/protobuf/util/delimited_message_util.h>
#include <google/protobuf/wrappers.pb.h>

#include <limits>
#include <utility>

#include "base/quoted.h"
#include "base/status_macros.h"
#include "blobtree/scene/operator_reader.h"

namespace isofield::catalog {
namespace {

using google::protobuf::util::ParseDelimitedFromZeroCopyStream;
using google::protobuf::util::SerializeDelimitedToZeroCopyStream;

// A scene with its operators, as the store keeps it. The serialized form is a Scene, followed by a StringValue (the
// name) and an Operator for each operator; each message has its length before it.
class SceneValue final : public Value {
 public:
  SceneValue(v1::Scene scene, std::shared_ptr<const SceneOperators> operators)
      : scene_(std::make_shared<const v1::Scene>(std::move(scene))), operators_(std::move(operators)) {}

  std::string serialized() const override {
    std::string bytes;
    google::protobuf::io::StringOutputStream out(&bytes);
    SerializeDelimitedToZeroCopyStream(*scene_, &out);
    for (const auto& [name, message] : operators_->messages) {
      google::protobuf::StringValue operator_name;
      operator_name.set_value(name);
      SerializeDelimitedToZeroCopyStream(operator_name, &out);
      SerializeDelimitedToZeroCopyStream(*message, &out);
    }
    return bytes;
  }
  std::uint64_t bytes() const override { return 0; }  // the number of scenes is limited, not their bytes

  const std::shared_ptr<const v1::Scene>& scene() const { return scene_; }
  const std::shared_ptr<const SceneOperators>& operators() const { return operators_; }

 private:
  const std::shared_ptr<const v1::Scene> scene_;
  const std::shared_ptr<const SceneOperators> operators_;
};

Entry scene_entry(const Record& record) {
  const auto& value = static_cast<const SceneValue&>(*record.value);
  return {record.name, record.version, value.scene(), value.operators()};
}

Shelf::Words words_of_scenes() {
  const auto not_found = [](const std::string& name, const std::string& there) {
    return absl::StrCat("no scene is named ", base::quoted(name), "; ",
                        there.empty() ? "the catalog is empty" : absl::StrCat("there are ", there));
  };
  return {.one = "scene", .many = "scenes", .not_found = not_found};
}

}  // namespace

Catalog::Catalog(Store& store, std::uint64_t max_scenes)
    : shelf_(store, Kind::kScene, {.entries = max_scenes}, words_of_scenes()) {}

absl::StatusOr<Catalog::Put> Catalog::put(const std::string& name, v1::Scene scene,
                                          std::shared_ptr<const SceneOperators> operators, const Condition& condition) {
  auto value = std::make_shared<const SceneValue>(std::move(scene), std::move(operators));
  ISOFIELD_ASSIGN_OR_RETURN(const Shelf::Put put, shelf_.put(name, std::move(value), condition));
  return Put{scene_entry(put.record), put.replaced_version};
}

absl::StatusOr<Entry> Catalog::get(const std::string& name) const {
  ISOFIELD_ASSIGN_OR_RETURN(const Record record, shelf_.get(name));
  return scene_entry(record);
}

absl::StatusOr<std::vector<Entry>> Catalog::list(const std::string& after, std::size_t most) const {
  ISOFIELD_ASSIGN_OR_RETURN(const std::vector<Record> records, shelf_.list(after, most));
  std::vector<Entry> entries;
  for (const Record& record : records) entries.push_back(scene_entry(record));
  return entries;
}

absl::StatusOr<std::uint64_t> Catalog::remove(const std::string& name) {
  ISOFIELD_ASSIGN_OR_RETURN(const Record removed, shelf_.remove(name));
  return removed.version;
}

absl::StatusOr<std::shared_ptr<const Value>> Catalog::parse(const std::string& serialized) {
  // Protobuf's streams count bytes in an int. A longer text would be cut, and operators at its end would be lost.
  if (serialized.size() > std::numeric_limits<int>::max()) {
    return absl::DataLossError("a kept scene has more than 2 GiB, which cannot be read");
  }
  google::protobuf::io::ArrayInputStream in(serialized.data(), static_cast<int>(serialized.size()));
  v1::Scene scene;
  bool is_end = false;
  if (!ParseDelimitedFromZeroCopyStream(&scene, &in, &is_end)) return absl::DataLossError("a kept scene is broken");
  auto operators = std::make_shared<SceneOperators>();
  for (google::protobuf::StringValue name; ParseDelimitedFromZeroCopyStream(&name, &in, &is_end); name.Clear()) {
    auto message = std::make_shared<v1::Operator>();
    if (!ParseDelimitedFromZeroCopyStream(message.get(), &in, nullptr)) break;
    ISOFIELD_ASSIGN_OR_RETURN(operators->table[name.value()], blobtree::read_operator(*message));
    operators->messages[name.value()] = std::move(message);
  }
  if (!is_end) return absl::DataLossError("the operators of a kept scene are broken");
  return std::make_shared<const SceneValue>(std::move(scene), std::move(operators));
}

}  // namespace isofield::catalog
