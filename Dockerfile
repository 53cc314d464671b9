# The program alone on Debian 12, run by a user of its own.
#
#   docker build -t poolhall .
#   docker run --rm -p 7777:7777 -p 8080:8080 -v poolhall:/data poolhall
#   docker run --rm -t poolhall tournament run /usr/share/poolhall/tournaments/demo.toml
FROM docker.io/library/debian:bookworm-slim AS build
WORKDIR /src
# The list of packages is the script's own; this layer changes only with it.
COPY pool ./
RUN ./pool packages
COPY . .
RUN ./pool build && strip build/release/poolhall

FROM docker.io/library/debian:bookworm-slim
RUN apt-get update -qq \
    && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends \
        libfmt9 libspdlog1.10 libsqlite3-0 libssl3 libstdc++6 libtomlplusplus3 \
    && rm -rf /var/lib/apt/lists/* \
    && useradd --system --home-dir /data --create-home --shell /usr/sbin/nologin poolhall
COPY --from=build /src/build/release/poolhall /usr/local/bin/poolhall
COPY --from=build /src/config /usr/share/poolhall
COPY --from=build /src/LICENSE /usr/share/doc/poolhall/LICENSE
USER poolhall
WORKDIR /data
VOLUME /data
EXPOSE 7777 8080
ENTRYPOINT ["poolhall"]
# Inside the container the ports must be open to its network; publish them with care.
CMD ["serve", "--listen", "0.0.0.0:7777", "--http", "0.0.0.0:8080", "--plain-beyond-loopback"]
