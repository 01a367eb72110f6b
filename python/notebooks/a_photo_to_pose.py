# SPDX-License-Identifier: Apache-2.0
# %% [markdown]
# # From photo to pose
# Ten lines. The town is an invented one; take a photo, a city model and a terrain of your own
# instead: `ridgeline.localize("photo.jpg", "city.gml", dtm="dtm.tif")` reads camera and prior from
# the photo's EXIF.

# %%
from common import save, town

# %%
import ridgeline

query = ridgeline.Dataset(town())["street_000"]
world = ridgeline.World.of_dataset(town())
localizer = ridgeline.Localizer(world)
found = localizer.localize(query.image, query.camera, query.prior)
print(found.status, found.pose)
print("confidence", round(found.confidence, 2), "standard deviations", found.covariance.diagonal() ** 0.5)
print("error", found.pose.error(query.truth))

# %% [markdown]
# The photo with the model's visible edges at the pose found, and the energy over the search box.

# %%
import matplotlib.pyplot as plt

edges = localizer.scene.visible_edges(found.pose, query.camera)
figure, (photo, energy) = plt.subplots(1, 2, figsize=(10, 4), width_ratios=[1.3, 1])
photo.imshow(ridgeline.read_picture(query.image)[:, :, ::-1])
for x0, y0, x1, y1 in edges["image"]:
    photo.plot([x0, x1], [y0, y1], color="yellow", linewidth=0.8)
photo.set_axis_off()
origin = found.map.east[0], found.map.north[0]
west, east, south, north = found.map.extent
shown = energy.imshow(
    found.map.energies,
    origin="lower",
    extent=(west - origin[0], east - origin[0], south - origin[1], north - origin[1]),
    cmap="viridis",
)
energy.plot(*(query.truth.center[:2] - origin), "w+", markersize=12, label="truth")
energy.plot(*(found.pose.center[:2] - origin), "rx", label="found")
energy.set_xlabel("east [m]")
energy.set_ylabel("north [m]")
energy.legend(loc="lower right")
figure.colorbar(shown, ax=energy, label="energy, least over headings")
save(figure, "photo_to_pose")

# %%
assert found.pose.error(query.truth)[0] < 3.0, "the demo picture is found"
