// SPDX-License-Identifier: Apache-2.0
#include "cli/render.h"

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/error.h"
#include "cli/command.h"
#include "cli/view_input.h"
#include "report/model_view.h"
#include "report/overlay.h"
#include "report/overlay_layers.h"
#include "report/picture_file.h"

namespace ridgeline {
namespace {

struct RenderArguments {
  ViewArguments view;
  std::string out;
  std::string shaded;
  std::string depth;
  std::string ids;
  bool no_legend = false;
};

int RunRender(const RenderArguments& arguments, const Context& context) {
  if (arguments.out.empty() && arguments.shaded.empty() && arguments.depth.empty() &&
      arguments.ids.empty()) {
    throw InputError("render", "", "nothing to write", "--out, --shaded, --depth or --ids");
  }
  if (arguments.out.empty() && arguments.no_legend) {
    throw InputError("--no-legend", "", "no edges to explain", "--out FILE");
  }
  if (arguments.out.empty() && !arguments.view.query.image.empty()) {
    throw InputError("--image", "", "no edges to draw over it", "--out FILE");
  }
  const std::unique_ptr<ViewInput> view = ReadView(arguments.view, context.threads);
  for (const Assumption& assumption : view->assumptions) context.Note(TextOf(assumption));
  for (const std::string& warning : view->warnings) context.Warn(warning);

  std::optional<ViewBuffers> buffers;
  const auto rendered = [&]() -> const ViewBuffers& {
    if (!buffers) buffers = view->scene->Render(view->camera, view->cam_from_local, true);
    return *buffers;
  };
  nlohmann::ordered_json written = nlohmann::ordered_json::object();
  const auto write = [&](const char* what, const std::string& file, const cv::Mat& picture) {
    WritePicture(picture, file);
    written[what] = file;
  };
  if (!arguments.depth.empty()) write("depth", arguments.depth, DepthPicture(rendered()));
  if (!arguments.ids.empty()) write("ids", arguments.ids, IdPicture(rendered()));
  if (!arguments.shaded.empty()) {
    write("shaded", arguments.shaded, ShadedPicture(rendered(), view->model));
  }
  if (!arguments.out.empty()) {
    Overlay overlay;
    overlay.layers = ModelEdgeLayers(*view->scene, view->camera, view->cam_from_local);
    OverlayDrawOptions options;
    options.legend = !arguments.no_legend;
    WriteOverlay(view->photo.empty() ? ShadedPicture(rendered(), view->model) : view->photo,
                 overlay,
                 options,
                 arguments.out);
    written["overlay"] = arguments.out;
  }
  if (context.json) {
    context.Print(written.dump(2));
  } else {
    for (const auto& [what, file] : written.items()) {
      context.Print(what + ": " + file.get<std::string>());
    }
  }
  return kExitOk;
}

}  // namespace

void AddRenderCommand(CLI::App& app, Context& context) {
  auto arguments = std::make_shared<RenderArguments>();
  CLI::App* command = AddCommand(
      app,
      context,
      {"render",
       "Draws the model as seen from a pose: edges over a photo, depth, ids.",
       "ridgeline render --dataset town/dataset.json --query street_000 --out edges.png"},
      [arguments](Context& c) { return RunRender(*arguments, c); });
  AddViewOptions(*command, arguments->view);
  command->add_option("--out", arguments->out, "Visible edges over the photo (.png, .jpg, .svg)");
  command->add_option("--shaded", arguments->shaded, "Shaded view of the model (.png, .jpg)");
  command->add_option("--depth", arguments->depth, "Depth, 16-bit centimetres, 0: sky (.png)");
  command->add_option("--ids", arguments->ids, "Surface index + 1 as 24-bit RGB, 0: sky (.png)");
  command->add_flag("--no-legend", arguments->no_legend, "Edges without a legend");
}

}  // namespace ridgeline
