# SPDX-License-Identifier: BSD-3-Clause
# An image in which a gate costs a minute: the program, its engines, cases and report, without compiler and sources.
#   docker build -t tripoint .
#   docker run --rm -v "$PWD:/project" -w /project tripoint tripoint validate cases --engine ./my-engine
# `make test-image` carries out these very instructions in a bare root without Docker, and runs a gate there (tools/image_root.py).
FROM debian:12 AS build
COPY tools/setup.sh /tripoint/tools/setup.sh
RUN apt-get update && /tripoint/tools/setup.sh build && apt-get install --yes --no-install-recommends git && rm -rf /var/lib/apt/lists/*
COPY . /tripoint
WORKDIR /tripoint
RUN --mount=type=cache,target=/root/.cache/ccache tools/build.sh 2 && tools/image_files.sh /opt/tripoint

FROM debian:12
COPY --from=build /opt/tripoint /opt/tripoint
RUN apt-get update && xargs apt-get install --yes --no-install-recommends < /opt/tripoint/packages && rm -rf /var/lib/apt/lists/*
ENV PATH=/opt/tripoint/bin:/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin
RUN tripoint engines
CMD ["tripoint", "--help"]
