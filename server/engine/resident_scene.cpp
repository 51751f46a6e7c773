#include "engine/resident_scene.h"

#include "blobtree/parameter_layout.h"
#include "engine/session.h"
#include "engine/status_macros.h"

namespace isofield::engine {

absl::StatusOr<std::shared_ptr<const ResidentScene>> ResidentScene::create(gpu::Device& device, blobtree::Tape tape) {
  std::shared_ptr<ResidentScene> scene(new ResidentScene);
  const blobtree::ParameterBuffers parameters = blobtree::lay_out(tape);
  ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(device));
  ISOFIELD_ASSIGN_OR_RETURN(scene->leaves_, session.upload(std::span(parameters.leaves)));
  ISOFIELD_ASSIGN_OR_RETURN(scene->operations_, session.upload(std::span(parameters.operations)));
  ISOFIELD_ASSIGN_OR_RETURN(scene->tables_, session.upload(std::span(parameters.tables)));
  ISOFIELD_RETURN_IF_ERROR(session.run());
  scene->tape_ = std::move(tape);
  return scene;
}

gpu::Commands::Bindings ResidentScene::bindings(const gpu::Buffer& code, const gpu::Commands::Bindings& own) const {
  gpu::Commands::Bindings all{{0, &leaves_}, {1, &operations_}, {2, &tables_}, {3, &code}};
  all.insert(all.end(), own.begin(), own.end());
  return all;
}

}  // namespace isofield::engine
