# The program alone on Debian 12, run by a user of its own, its database in the volume /data.
#
#   docker build -t poolhall .
#   docker run -d --name hall -p 7777:7777 -p 8080:8080 -v poolhall:/data poolhall
#   docker run --rm -t poolhall tournament run /usr/share/poolhall/tournaments/demo.toml
#
# Podman takes the same commands (for the health check: podman build --format docker). Without an engine
# packaging/image/run builds and tries it with buildah alone; packaging/README.md has its figures.
FROM docker.io/library/debian:bookworm-slim AS build
WORKDIR /src
# The list of packages is the script's own; this layer changes only with it.
COPY pool ./
RUN ./pool packages
COPY . .
RUN ./pool package program

FROM docker.io/library/debian:bookworm-slim
# The package brings the libraries that it needs.
RUN --mount=type=bind,from=build,source=/src/build/packages,target=/packages \
    apt-get update -qq \
    && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends \
        /packages/poolhall_*.deb \
    && apt-get clean && rm -rf /var/lib/apt/lists/* \
    && useradd --system --home-dir /data --create-home --shell /usr/sbin/nologin poolhall
USER poolhall
WORKDIR /data
VOLUME /data
EXPOSE 7777 8080
# 503 while the database takes nothing. Another port than 8080 needs another check.
HEALTHCHECK --interval=30s --timeout=5s --start-period=10s CMD ["/bin/bash", "-c", \
  "exec 3<>/dev/tcp/127.0.0.1/8080 && printf 'GET /healthz HTTP/1.0\\r\\nHost: 127.0.0.1\\r\\n\\r\\n' >&3 && head -n 1 <&3 | grep -q ' 200 '"]
STOPSIGNAL SIGTERM
ENTRYPOINT ["poolhall"]
# Inside the container the ports must be open to its network; publish them with care.
CMD ["serve", "--listen", "0.0.0.0:7777", "--http", "0.0.0.0:8080", "--plain-beyond-loopback"]
