# SPDX-License-Identifier: BSD-3-Clause
# An image in which a gate costs a minute: the program, its engines, cases and report, without compiler and sources.
#   docker build -t tripoint .
#   docker run --rm -v "$PWD:/project" -w /project tripoint tripoint validate cases --engine ./my-engine
# `make test-image` carries out these very instructions in a bare root without Docker, and runs a gate there (tools/image_root.py).
# To build the same image at a later day: --build-arg DEBIAN=debian@sha256:..., which a published image has in its label org.opencontainers.image.base.name,
# and --build-arg SNAPSHOT=yes, which takes the packages of the day on which that Debian was made (and so none of the fixes since).
ARG DEBIAN=debian:12
FROM ${DEBIAN} AS build
ARG SNAPSHOT=
COPY tools/setup.sh tools/debian_snapshot.sh /tripoint/tools/
RUN if [ -n "$SNAPSHOT" ]; then /tripoint/tools/debian_snapshot.sh; fi
RUN apt-get update && /tripoint/tools/setup.sh build && apt-get install --yes --no-install-recommends git && rm -rf /var/lib/apt/lists/*
COPY . /tripoint
WORKDIR /tripoint
RUN --mount=type=cache,target=/root/.cache/ccache tools/build.sh 2 && tools/image_files.sh /opt/tripoint

FROM ${DEBIAN}
ARG SNAPSHOT=
COPY tools/debian_snapshot.sh /tmp/debian_snapshot.sh
RUN if [ -n "$SNAPSHOT" ]; then /tmp/debian_snapshot.sh; fi; rm /tmp/debian_snapshot.sh
COPY --from=build /opt/tripoint /opt/tripoint
# bubblewrap is for --sandbox; whether it may make namespaces is up to who starts the container (docs/ci.md).
RUN apt-get update && xargs apt-get install --yes --no-install-recommends bubblewrap < /opt/tripoint/packages && rm -rf /var/lib/apt/lists/*
ENV PATH=/opt/tripoint/bin:/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin
RUN tripoint engines
CMD ["tripoint", "--help"]
