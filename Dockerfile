# SPDX-License-Identifier: BSD-3-Clause
# Untested: the same two commands as everywhere, in a container. What is tested is `make test-fresh`, a bare root without Docker.
#   docker build -t tripoint .  &&  docker run --rm -v "$PWD/report:/tripoint/report" tripoint
FROM debian:12
RUN apt-get update && apt-get install --yes --no-install-recommends make git ca-certificates && rm -rf /var/lib/apt/lists/*
COPY . /tripoint
WORKDIR /tripoint
RUN make setup build
CMD ["make", "validate"]
