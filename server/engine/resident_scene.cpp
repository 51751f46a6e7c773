#include "engine/resident_scene.h"

#include "blobtree/parameter_layout.h"
#include "engine/session.h"
#include "engine/status_macros.h"

namespace isofield::engine {
namespace {

constexpr std::uint32_t kFirstVolumeBinding = 12;  // shaders/lib/volume.glsl

}  // namespace

absl::StatusOr<std::shared_ptr<const ResidentScene>> ResidentScene::create(gpu::Device& device, VolumeCache& volumes,
                                                                           blobtree::Tape tape) {
  std::shared_ptr<ResidentScene> scene(new ResidentScene);
  const blobtree::ParameterBuffers parameters = blobtree::lay_out(tape);
  ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(device));
  ISOFIELD_ASSIGN_OR_RETURN(scene->leaves_, session.upload(std::span(parameters.leaves)));
  ISOFIELD_ASSIGN_OR_RETURN(scene->operations_, session.upload(std::span(parameters.operations)));
  ISOFIELD_ASSIGN_OR_RETURN(scene->tables_, session.upload(std::span(parameters.tables)));
  ISOFIELD_RETURN_IF_ERROR(session.run());
  for (const auto& op : tape.volumes) {
    ISOFIELD_ASSIGN_OR_RETURN(VolumeLease volume, volumes.get(*op));
    scene->volumes_.push_back(std::move(volume));
  }
  scene->tape_ = std::move(tape);
  return scene;
}

std::uint64_t ResidentScene::device_bytes() const {
  std::uint64_t bytes = leaves_.size() + operations_.size() + tables_.size();
  for (const VolumeLease& volume : volumes_) bytes += volume->bytes();
  return bytes;
}

gpu::Commands::Bindings ResidentScene::bindings(const gpu::Buffer& code, const gpu::Commands::Bindings& own) const {
  gpu::Commands::Bindings all{{0, &leaves_}, {1, &operations_}, {2, &tables_}, {3, &code}};
  for (std::uint32_t slot = 0; slot < volumes_.size(); ++slot) {
    all.push_back({kFirstVolumeBinding + slot, &volumes_[slot]->buffer()});
  }
  all.insert(all.end(), own.begin(), own.end());
  return all;
}

}  // namespace isofield::engine
