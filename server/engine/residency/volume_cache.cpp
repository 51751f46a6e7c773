#include "engine/residency/volume_cache.h"

#include <absl/hash/hash.h>
#include <absl/status/status.h>
#include <absl/strings/str_cat.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string_view>
#include <vector>

#include "base/status_macros.h"
#include "engine/kernels/bindings.h"
#include "engine/session.h"
#include "operators/profile_table.h"
#include "shaders/embedded.h"

namespace isofield::engine {
namespace {

using operators::Operator;
using operators::Silhouette;

// The numbers of a layer of nodes with the same theta, for operator_volume.comp: t = tan(theta) and dt/dtheta.
using Angle = std::array<float, 2>;

std::vector<Angle> angles(int size) {
  std::vector<Angle> result;
  for (int k = 0; k < size; ++k) {
    const double t = std::tan(k * (std::numbers::pi / 4) / (size - 1));
    result.push_back({static_cast<float>(t), static_cast<float>(1 + t * t)});
  }
  return result;
}

// Records the dispatches that fill the nodes of a Gradient's volume. The buffer holds the nodes when the session has
// run; `inputs` must live until then.
absl::StatusOr<gpu::Buffer> fill_gradient(Session& session, KernelCache& kernels, const operators::Gradient& op,
                                          std::vector<gpu::Buffer>& inputs) {
  const auto size = static_cast<std::uint32_t>(op.volume);
  const bool is_smooth = op.silhouette.kind == Silhouette::Kind::kSmooth;
  const std::vector<Angle> layers = angles(op.volume);
  const operators::ProfileTable table =
      is_smooth ? operators::ProfileTable(1) : operators::silhouette_table(op.silhouette);
  ISOFIELD_ASSIGN_OR_RETURN(gpu::Buffer layer_buffer, session.upload(std::span(layers)));
  ISOFIELD_ASSIGN_OR_RETURN(gpu::Buffer table_buffer, session.upload(std::span(table)));
  ISOFIELD_ASSIGN_OR_RETURN(gpu::Buffer nodes, session.scratch(sizeof(float) * 4 * size * size * size));
  for (const auto& shader : {is_smooth ? shaders::kSmoothVolumeLow : shaders::kTableVolumeLow,
                             is_smooth ? shaders::kSmoothVolumeHigh : shaders::kTableVolumeHigh}) {
    ISOFIELD_ASSIGN_OR_RETURN(const gpu::SharedPipeline kernel, kernels.get(shader));
    ISOFIELD_RETURN_IF_ERROR(session.commands().dispatch(kernel,
                                                         {{binding::scene::kTables, &table_buffer},
                                                          {binding::operator_volume::kAngles, &layer_buffer},
                                                          {binding::operator_volume::kNodes, &nodes}},
                                                         size, size / 4 * size));
  }
  inputs.push_back(std::move(layer_buffer));
  inputs.push_back(std::move(table_buffer));
  return nodes;
}

absl::StatusOr<gpu::Buffer> fill_sampled(Session& session, KernelCache& kernels,
                                         const operators::SampledVolume& samples, std::vector<gpu::Buffer>& inputs) {
  const auto size = static_cast<std::uint32_t>(samples.size);
  ISOFIELD_ASSIGN_OR_RETURN(gpu::Buffer sample_buffer, session.upload(std::span(samples.values)));
  ISOFIELD_ASSIGN_OR_RETURN(gpu::Buffer nodes, session.scratch(sizeof(float) * 4 * samples.values.size()));
  ISOFIELD_ASSIGN_OR_RETURN(const gpu::SharedPipeline kernel, kernels.get(shaders::kSampledVolume));
  ISOFIELD_RETURN_IF_ERROR(session.commands().dispatch(
      kernel, {{binding::sampled_volume::kSamples, &sample_buffer}, {binding::sampled_volume::kNodes, &nodes}}, size,
      (size * size * size + 63) / 64));
  inputs.push_back(std::move(sample_buffer));
  return nodes;
}

std::size_t digest(const operators::SampledVolume& samples) {
  return absl::HashOf(
      std::string_view(reinterpret_cast<const char*>(samples.values.data()), samples.values.size() * sizeof(float)));
}

const operators::SampledVolume* samples_of(const Operator& op) {
  const auto* sampled = op.as<operators::Sampled>();
  return sampled ? sampled->samples.get() : nullptr;
}

}  // namespace

VolumeLease VolumeCache::Place::lease() {
  const base::MutexLock lock(mutex);
  return volume.lock();
}

absl::StatusOr<VolumeCache::Key> VolumeCache::key_of(const Operator& op) {
  if (const auto* gradient = op.as<operators::Gradient>()) {
    for (const int size : {16, 32, 64, 128}) {
      if (gradient->volume == size) return Key{op.kind(), gradient->silhouette, size, 0};
    }
    return absl::InvalidArgumentError(absl::StrCat("a volume of ", gradient->volume, " samples a side"));
  }
  if (const operators::SampledVolume* samples = samples_of(op); samples && samples->size >= 2 && samples->size <= 128) {
    const auto n = static_cast<std::size_t>(samples->size);
    if (samples->values.size() == n * n * n) return Key{op.kind(), {}, samples->size, digest(*samples)};
  }
  return absl::InvalidArgumentError("an operator without a volume");
}

std::shared_ptr<VolumeCache::Place> VolumeCache::place_of(const Key& key) {
  const base::MutexLock lock(mutex_);
  // Removes the places of volumes that nobody builds or holds.
  std::erase_if(places_, [](const auto& p) { return p.second.use_count() == 1 && !p.second->lease(); });
  std::shared_ptr<Place>& place = places_[key];
  if (!place) place = std::make_shared<Place>();
  return place;
}

absl::StatusOr<VolumeLease> VolumeCache::build(const Operator& op) {
  std::vector<gpu::Buffer> inputs;  // declared before the session, so that they outlive it
  ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(device_));
  const auto* sampled = op.as<operators::Sampled>();
  ISOFIELD_ASSIGN_OR_RETURN(gpu::Buffer nodes,
                            sampled ? fill_sampled(session, kernels_, *sampled->samples, inputs)
                                    : fill_gradient(session, kernels_, *op.as<operators::Gradient>(), inputs));
  ISOFIELD_RETURN_IF_ERROR(session.run());
  return VolumeLease(new Volume(std::move(nodes), op.volume_key().size, sampled ? sampled->samples : nullptr));
}

absl::StatusOr<VolumeLease> VolumeCache::get(const Operator& op) {
  ISOFIELD_ASSIGN_OR_RETURN(const Key key, key_of(op));
  const std::shared_ptr<Place> place = place_of(key);
  const base::MutexLock lock(place->building);
  if (VolumeLease volume = place->lease()) {
    const operators::SampledVolume* samples = samples_of(op);
    const bool is_same = !samples || samples == volume->samples_.get() || samples->values == volume->samples_->values;
    // Different samples can have the same digest; their volume is not shared.
    return is_same ? absl::StatusOr<VolumeLease>(volume) : build(op);
  }
  ISOFIELD_ASSIGN_OR_RETURN(VolumeLease volume, build(op));
  const base::MutexLock publishing(place->mutex);
  place->volume = volume;
  return volume;
}

std::uint64_t VolumeCache::resident_bytes(const Operator& op) const {
  const absl::StatusOr<Key> key = key_of(op);
  if (!key.ok()) return 0;
  const base::MutexLock lock(mutex_);
  const auto place = places_.find(*key);
  if (place == places_.end()) return 0;
  const VolumeLease volume = place->second->lease();
  return volume ? volume->bytes() : 0;
}

VolumeCache::Usage VolumeCache::usage() const {
  const base::MutexLock lock(mutex_);
  Usage usage;
  for (const auto& [key, place] : places_) {
    if (const VolumeLease volume = place->lease()) {
      ++usage.volumes;
      usage.bytes += volume->bytes();
    }
  }
  return usage;
}

}  // namespace isofield::engine
