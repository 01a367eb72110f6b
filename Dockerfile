# SPDX-License-Identifier: Apache-2.0
# docker build -t ridgeline . && docker run --rm -v "$PWD:/data" -w /data ridgeline localize ...
# The packages are those of scripts/packages.txt, here and in .devcontainer.
FROM debian:bookworm AS packages
COPY scripts/packages.txt scripts/install_packages.sh /tmp/scripts/
RUN apt-get update && apt-get install -y --no-install-recommends ca-certificates git \
    && /tmp/scripts/install_packages.sh && rm -rf /var/lib/apt/lists/*

FROM packages AS build
COPY . /src
WORKDIR /src
RUN git config --global --add safe.directory /src && scripts/package.sh

FROM debian:bookworm-slim
COPY --from=build /src/build/package/ridgeline_*.deb /tmp/
RUN apt-get update && apt-get install -y --no-install-recommends /tmp/ridgeline_*.deb \
    && rm -rf /var/lib/apt/lists/* /tmp/ridgeline_*.deb
ENTRYPOINT ["ridgeline"]
