// A measuring plane on its plan: false colour, isolines, the room, luminaires by number, scale bar, legend.
const PLAN_WIDTH = 1400, PLAN_MOST_HEIGHT = 1500, LEGEND_WIDTH = 150, MOST_NUMBERED = 120, LATTICE = 180;
const PLAN_PENS = { edge: ["#787878", 2], wall: ["#5a5a5a", 6], window: ["#6eaae1", 8], luminaire: ["#7a3f00", 2.2] };

class PlanPicture {
  constructor(target, colours, top) {
    this.target = target;
    this.plan = target.plan;
    this.colours = colours.map((colour) => colour.map((c) => Math.round(c + 0.25 * (255 - c))));  // to be written on
    this.scale = top;
    const [x0, y0] = this.plan.low, [x1, y1] = this.plan.high;
    this.pxPerM = Math.min((PLAN_WIDTH - LEGEND_WIDTH) / (x1 - x0), PLAN_MOST_HEIGHT / (y1 - y0));
    this.width = Math.ceil(this.pxPerM * (x1 - x0));
    this.height = Math.ceil(this.pxPerM * (y1 - y0));
    this.canvas = document.createElement("canvas");
    this.canvas.width = this.width + LEGEND_WIDTH;
    this.canvas.height = this.height + 60;
    this.canvas.style.width = this.canvas.width / 1.4 + "px";
    this.context = this.canvas.getContext("2d");
    this.small = document.createElement("canvas");
    this.roomPicture = this.drawRoom();
  }

  at(x, y) { return [(x - this.plan.low[0]) * this.pxPerM, (this.plan.high[1] - y) * this.pxPerM]; }
  onGrid(i, j, nx, ny) {
    const { origin, u, v, size } = this.plan, a = size[0] * i / (nx - 1), b = size[1] * j / (ny - 1);
    return this.at(origin[0] + a * u[0] + b * v[0], origin[1] + a * u[1] + b * v[1]);
  }

  colourOf(lx) {
    return this.colours[Math.max(0, Math.min(255, Math.round(255 * lx / this.scale.top)))];
  }

  draw(lx) {
    const c = this.context;
    c.setTransform(1, 0, 0, 1, 0, 0);
    c.fillStyle = "#ffffff";
    c.fillRect(0, 0, this.canvas.width, this.canvas.height);
    const { nu, nv, squares } = this.plan, grid = new Float64Array(nu * nv);
    let least = Infinity, greatest = 0;
    squares.forEach((index, k) => {
      grid[k] = index === 0xffffffff ? NaN : lx[index];
      if (grid[k] < least) least = grid[k];
      if (grid[k] > greatest) greatest = grid[k];
    });
    const lattice = latticeOf(grid, nu, nv, LATTICE);
    c.save();
    this.clipToPlane(c);
    this.paint(c, lattice);
    c.restore();
    c.drawImage(this.roomPicture, 0, 0);
    c.save();
    this.clipToPlane(c);
    const labels = [];
    const taken = this.plan.luminaires.length > MOST_NUMBERED ? [] : this.plan.luminaires.map(([x, y]) => this.at(x, y));
    if (least < greatest) for (const level of customaryLevels(least, greatest)) labels.push(this.isoline(c, lattice, level, taken));
    c.restore();
    this.numbers(c);
    labels.forEach((label) => { if (label) this.word(c, ...label, 22, "#191919"); });
    this.legend(c);
    this.scaleBar(c);
  }

  clipToPlane(c) {
    c.beginPath();
    for (const ring of this.plan.rings) this.path(c, ring, true);
    c.clip("evenodd");
  }

  path(c, flat, closed) {
    for (let k = 0; k < flat.length; k += 2) {
      const [x, y] = this.at(flat[k], flat[k + 1]);
      if (k === 0) c.moveTo(x, y); else c.lineTo(x, y);
    }
    if (closed) c.closePath();
  }

  // A pixel for each crossing of the lattice, stretched over the plane.
  paint(c, lattice) {
    const { nx, ny, values } = lattice;
    this.small.width = nx;
    this.small.height = ny;
    const small = this.small.getContext("2d"), image = small.createImageData(nx, ny);
    for (let i = 0; i < values.length; i++) {
      if (Number.isNaN(values[i])) continue;
      const colour = this.colourOf(values[i]);
      for (let k = 0; k < 3; k++) image.data[4 * i + k] = colour[k];
      image.data[4 * i + 3] = 255;
    }
    small.putImageData(image, 0, 0);
    const o = this.onGrid(-0.5, -0.5, nx, ny), x = this.onGrid(0.5, -0.5, nx, ny), y = this.onGrid(-0.5, 0.5, nx, ny);
    c.setTransform(x[0] - o[0], x[1] - o[1], y[0] - o[0], y[1] - o[1], o[0], o[1]);
    c.imageSmoothingEnabled = true;
    c.drawImage(this.small, 0, 0);
    c.setTransform(1, 0, 0, 1, 0, 0);
  }

  // Draws a level and returns where its label belongs: on the part of the line farthest from the plane's edge that is
  // free of other words, whose places are in `taken`.
  isoline(c, lattice, level, taken) {
    const { nx, ny } = lattice, segments = segmentsAt(lattice, level);
    c.beginPath();
    let best = null, most = 3;
    for (const [x0, y0, x1, y1] of segments) {
      c.moveTo(...this.onGrid(x0, y0, nx, ny));
      c.lineTo(...this.onGrid(x1, y1, nx, ny));
      const inside = Math.min(x0, y0, nx - 1 - x0, ny - 1 - y0);
      if (inside <= most) continue;
      const place = this.onGrid((x0 + x1) / 2, (y0 + y1) / 2, nx, ny);
      if (taken.some((other) => Math.abs(other[0] - place[0]) < 56 && Math.abs(other[1] - place[1]) < 28)) continue;
      most = inside;
      best = place;
    }
    if (best) taken.push(best);
    c.lineWidth = 2.2;
    c.strokeStyle = "#191919";
    c.stroke();
    return best && [best, String(Number(level.toPrecision(6)))];
  }

  word(c, [x, y], text, size, colour, align = "center") {
    c.font = `${size}px Arial, "Liberation Sans", "DejaVu Sans", sans-serif`;
    c.textAlign = align;
    c.textBaseline = "middle";
    c.lineJoin = "round";
    c.lineWidth = 5;
    c.strokeStyle = "#ffffff";
    c.strokeText(text, x, y);
    c.fillStyle = colour;
    c.fillText(text, x, y);
  }

  drawRoom() {
    const picture = document.createElement("canvas");
    picture.width = this.width;
    picture.height = this.height;
    const c = picture.getContext("2d");
    for (const line of this.plan.lines) {
      const [colour, width] = PLAN_PENS[line.stroke];
      c.beginPath();
      this.path(c, line.points, false);
      c.strokeStyle = colour;
      c.lineWidth = width;
      c.stroke();
    }
    c.setLineDash([8, 6]);
    c.strokeStyle = "#6e6e6e";
    c.lineWidth = 2;
    c.beginPath();
    for (const ring of this.plan.rings) this.path(c, ring, true);
    c.stroke();
    return picture;
  }

  numbers(c) {
    const places = this.plan.luminaires;
    if (places.length > MOST_NUMBERED) return;
    places.forEach(([x, y], k) => this.word(c, this.at(x, y), String(k + 1), 22, "#7a3f00"));
  }

  legend(c) {
    const x = this.width + 24, height = Math.max(200, this.height - 60), top = 44;
    for (let k = 0; k < height; k++) {
      c.fillStyle = `rgb(${this.colourOf(this.scale.top * (1 - (k + 0.5) / height))})`;
      c.fillRect(x, top + k, 26, 1.5);
    }
    this.word(c, [x, 20], "lx", 22, "#1c1e21", "left");
    for (let v = 0; v <= this.scale.top * 1.0001; v += this.scale.step)
      this.word(c, [x + 34, top + height * (1 - v / this.scale.top)], String(Number(v.toPrecision(6))), 20, "#1c1e21", "left");
  }

  scaleBar(c) {
    const metres = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000].find((m) => m * this.pxPerM > 0.12 * this.width) ?? 1;
    const y = this.height + 24;
    c.fillStyle = "#1c1e21";
    c.fillRect(4, y, metres * this.pxPerM, 5);
    this.word(c, [4, y + 22], `${metres} m`, 20, "#1c1e21", "left");
    const { north } = this.plan;
    if (!north) return;
    const middle = [this.width - 30, y + 8], tip = [middle[0] + 24 * north[0], middle[1] - 24 * north[1]];
    c.beginPath();
    c.moveTo(middle[0] - 24 * north[0], middle[1] + 24 * north[1]);
    c.lineTo(...tip);
    c.lineWidth = 3;
    c.strokeStyle = "#1c1e21";
    c.stroke();
    this.word(c, [tip[0] + 16 * north[0] - 14, tip[1]], "N", 20, "#1c1e21");
  }
}
