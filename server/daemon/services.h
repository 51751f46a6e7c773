// Makes all objects that serve requests, from the store to the gRPC services, in the order in which they depend on one
// another.
#pragma once

#include <grpcpp/grpcpp.h>

#include <memory>
#include <string>
#include <vector>

#include "catalog/catalog.h"
#include "catalog/memory_store.h"
#include "catalog/operator_catalog.h"
#include "daemon/config.h"
#include "engine/compile_ahead.h"
#include "engine/engine.h"
#include "rpc/admission.h"
#include "rpc/call_log.h"
#include "rpc/field_service.h"
#include "rpc/info_service.h"
#include "rpc/mesh_service.h"
#include "rpc/operator_service.h"
#include "rpc/reflection_service.h"
#include "rpc/scene_service.h"
#include "rpc/shared_regions.h"
#include "rpc/surface_service.h"
#include "scenes/resident_scenes.h"
#include "scenes/scene_editor.h"
#include "scenes/scene_source.h"

namespace isofield::daemon {

// Owns the store, the catalogs, the admissions, the gRPC services and what connects them.
class Services {
 public:
  // `engine` must outlive this. `specialised` has the specialised kernels of its device.
  Services(const Config& config, const std::string& version, engine::Engine& engine,
           std::shared_ptr<engine::SpecialisedKernels> specialised);
  Services(const Services&) = delete;
  Services& operator=(const Services&) = delete;

  // Returns the full names of isofield's own services.
  static std::vector<std::string> names();
  // Returns all services that gRPC must register, that of reflection included.
  std::vector<grpc::Service*> all();
  rpc::FieldService& fields() { return field_service_; }
  rpc::SharedRegions& shared_regions() { return shared_regions_; }
  rpc::CallLog& call_log() { return call_log_; }

 private:
  // A member uses only members before it.
  const rpc::Limits limits_;
  rpc::Admission batches_, requests_;
  rpc::SharedRegions shared_regions_;
  rpc::CallLog call_log_;
  catalog::MemoryStore store_;
  catalog::Catalog catalog_;
  catalog::OperatorCatalog operators_;
  scenes::ResidentScenes residents_;
  const scenes::SceneSource scenes_;
  const std::unique_ptr<engine::CompileAhead> ahead_;  // null if nothing is compiled ahead
  scenes::SceneEditor editor_;
  rpc::SceneService scene_service_;
  rpc::OperatorService operator_service_;
  rpc::FieldService field_service_;
  rpc::MeshService mesh_service_;
  rpc::SurfaceService surface_service_;
  rpc::InfoService info_service_;
  rpc::ReflectionService reflection_service_;
};

}  // namespace isofield::daemon
