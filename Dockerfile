# SPDX-License-Identifier: LGPL-2.1-or-later
#
#   docker build --tag ricochet .                               Debian 12
#   docker build --tag ricochet --build-arg DEBIAN=trixie .     Debian 13
#   docker run --rm --user "$(id -u)" --volume "$PWD:/work" ricochet mine.prm
ARG DEBIAN=bookworm
FROM debian:${DEBIAN}

# Packages are a layer of their own, which stays as long as the list does.
COPY scripts/setup.sh /src/scripts/setup.sh
RUN bash -c "source /src/scripts/setup.sh"

COPY . /src
RUN bash -c "source /src/scripts/setup.sh; configure release; ninja -C build/release programs; \
  cmake --install build/release" && rm -r /src/build

RUN useradd --create-home --home-dir /work ricochet
USER ricochet
WORKDIR /work
ENTRYPOINT ["ricochet"]
