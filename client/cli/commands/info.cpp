#include <absl/strings/str_format.h>

#include <memory>

#include "commands/command_line.h"
#include "commands/context.h"
#include "json_output.h"

namespace isofield {
namespace {

constexpr double kMiB = 1 << 20;

// Prints the device, and the tuning numbers that the server has chosen for it.
void print_device(const v1::DeviceInfo& device) {
  absl::PrintF("device   %s (%s)\n", device.name(), device.type());
  absl::PrintF("driver   %s; Vulkan %s\n", device.driver(), device.vulkan_version());
  absl::PrintF("limits   subgroups of %u; %u bytes a buffer\n", device.subgroup_size(), device.max_buffer_bytes());
  absl::PrintF("profile\n");
  for (const v1::TuningNumber& n : device.profile()) {
    absl::PrintF("  %-26s %12u  %s (%s)\n", n.name(), n.value(), n.meaning(), n.unit());
  }
}

absl::Status info(const Context& context, bool of_device) {
  auto client = context.connect();
  if (!client.ok()) return client.status();
  const auto info = client->info();
  if (!info.ok()) return info.status();
  if (context.json) {
    of_device ? print_json(info->device()) : print_json(*info);
    return absl::OkStatus();
  }
  if (of_device) {
    print_device(info->device());
    return absl::OkStatus();
  }
  const auto& device = info->device();
  const auto& limits = info->limits();
  absl::PrintF("isofieldd %s at %s, up for %.0f s\n", info->version(), context.server, info->uptime_seconds());
  absl::PrintF("device   %s (%s); Vulkan %s; %s; subgroups of %u\n", device.name(), device.type(),
               device.vulkan_version(), device.driver(), device.subgroup_size());
  absl::PrintF("resident %u scenes, %.1f MiB of scenes, %.1f MiB in all\n", info->resident_scenes(),
               static_cast<double>(info->scene_bytes()) / kMiB, static_cast<double>(info->device_bytes()) / kMiB);
  absl::PrintF(
      "limits   %u scenes; %u custom operators (%u there); %u nodes and %u primitives a scene; stack depth %u\n",
      limits.max_scenes(), limits.max_operators(), info->operators(), limits.max_nodes(), limits.max_primitives(),
      limits.max_stack_depth());
  absl::PrintF("         %u bytes and %u points a message; %u points a grid; %u cells a mesh\n",
               limits.max_message_bytes(), limits.max_points_per_message(), limits.max_grid_points(),
               limits.max_mesh_cells());
  absl::PrintF("         %u evaluations with %u points may wait or run; %u other requests with %u points may run\n",
               limits.max_queued_requests(), limits.max_queued_points(), limits.max_running_requests(),
               limits.max_running_points());
  return absl::OkStatus();
}

}  // namespace

void add_info_command(Command app, Context& context) {
  Command command = app.add_subcommand("info", "Show the server's version, device and limits, and what it holds");
  const auto of_device = std::make_shared<bool>(false);
  command.add_flag("--device", *of_device, "Show only the device, with the tuning numbers for it");
  command.callback([&context, of_device] { context.outcome = info(context, *of_device); });
}

}  // namespace isofield
