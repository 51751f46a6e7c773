#include "engine/residency/resident_scene.h"

#include "base/status_macros.h"
#include "engine/kernels/bindings.h"

namespace isofield::engine {
namespace {

static_assert(binding::scene::kUniformLeaves == gpu::kFirstUniformBinding);

}  // namespace

absl::StatusOr<std::shared_ptr<const ResidentScene>> ResidentScene::create(gpu::Device& device, VolumeCache& volumes,
                                                                           blobtree::Tape tape) {
  std::shared_ptr<ResidentScene> scene(new ResidentScene);
  scene->parameters_ = blobtree::lay_out(tape);
  ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(device));
  ISOFIELD_ASSIGN_OR_RETURN(gpu::Buffer leaves, session.upload(std::span(scene->parameters_.leaves)));
  scene->leaves_ = std::make_shared<const gpu::Buffer>(std::move(leaves));
  ISOFIELD_RETURN_IF_ERROR(scene->upload_operations(session));
  ISOFIELD_RETURN_IF_ERROR(session.run());
  for (const auto& op : tape.volumes) {
    ISOFIELD_ASSIGN_OR_RETURN(VolumeLease volume, volumes.get(*op));
    scene->volumes_.push_back(std::move(volume));
  }
  scene->tape_ = std::move(tape);
  return scene;
}

absl::StatusOr<std::shared_ptr<const ResidentScene>> ResidentScene::with_operations(gpu::Device& device,
                                                                                    blobtree::Tape tape) const {
  std::shared_ptr<ResidentScene> scene(new ResidentScene);
  ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(device));
  scene->parameters_ = blobtree::lay_out_operations(tape);
  scene->parameters_.leaves = parameters_.leaves;
  ISOFIELD_RETURN_IF_ERROR(scene->upload_operations(session));
  ISOFIELD_RETURN_IF_ERROR(session.run());
  scene->leaves_ = leaves_;
  scene->volumes_ = volumes_;
  scene->tape_ = std::move(tape);
  return scene;
}

absl::Status ResidentScene::upload_operations(Session& session) {
  ISOFIELD_ASSIGN_OR_RETURN(operations_, session.upload(std::span(parameters_.operations)));
  ISOFIELD_ASSIGN_OR_RETURN(tables_, session.upload(std::span(parameters_.tables)));
  return absl::OkStatus();
}

std::uint64_t ResidentScene::device_bytes() const {
  std::uint64_t bytes = own_bytes();
  for (const VolumeLease& volume : volumes_) bytes += volume->bytes();
  return bytes;
}

gpu::Commands::Bindings ResidentScene::bindings(const gpu::Buffer& code, const gpu::Commands::Bindings& own) const {
  gpu::Commands::Bindings all{{binding::scene::kLeaves, leaves_.get()},
                              {binding::scene::kOperations, &operations_},
                              {binding::scene::kTables, &tables_},
                              {binding::scene::kTape, &code},
                              {binding::scene::kUniformLeaves, leaves_.get()},
                              {binding::scene::kUniformOperations, &operations_}};
  for (std::uint32_t slot = 0; slot < volumes_.size(); ++slot) {
    all.push_back({binding::scene::kFirstVolume + slot, &volumes_[slot]->buffer()});
  }
  all.insert(all.end(), own.begin(), own.end());
  return all;
}

}  // namespace isofield::engine
