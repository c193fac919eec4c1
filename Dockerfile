# Rink on an empty Debian 12: building the image runs the README's two commands, so an image that exists has passed them.
#   docker build -t rink . && docker run --rm -p 4711:4711 rink serve match --address 0.0.0.0
FROM debian:12
RUN apt-get update && apt-get install -y --no-install-recommends git && rm -rf /var/lib/apt/lists/*
COPY . /rink
WORKDIR /rink
RUN ./rink compare --out /rink/report
RUN ./rink test
ENTRYPOINT ["./rink"]
CMD ["help"]
