// The page: unpacks the light of each group, draws everything for the lights as the sliders have them.
const MOST_PLACES = 60;

async function unpackRoom(data) {
  for (const target of data.targets) {
    target.values = await Promise.all(target.groups.map((g) => unpackFloats(g.lx)));
    target.errors = await Promise.all(target.groups.map((g) => unpackFloats(g.error)));
    target.meanErrors = target.groups.map((g) => g.mean_error);
    if (target.weights) target.weights = await unpackFloats(target.weights);
    if (target.plan) target.plan.squares = await unpackIndices(target.plan.squares);
  }
  for (const rating of data.glare) {
    rating.sums = await Promise.all(rating.groups.map((g) => unpackFloats(g.sum)));
    rating.backgrounds = await Promise.all(rating.groups.map((g) => unpackFloats(g.background)));
  }
}

// A view as the eye would see it on this screen.
class ViewPicture {
  constructor(picture, lights) {
    this.lights = lights;
    this.canvas = el("canvas", { width: picture.width, height: picture.height, role: "img", "aria-label": `Picture of the view ${picture.name}` });
    this.context = this.canvas.getContext("2d");
    this.image = this.context.createImageData(picture.width, picture.height);
    this.dither = ditherPattern(picture.width, picture.height);
    const n = picture.width * picture.height;
    this.X = new Float32Array(n);
    this.Y = new Float32Array(n);
    this.Z = new Float32Array(n);
    this.white = null;
  }

  mix(factors) {
    const { X, Y, Z } = this;
    X.fill(0); Y.fill(0); Z.fill(0);
    this.lights.forEach((light, g) => {
      const f = factors[g];
      if (f === 0) return;
      const from = light.Y;
      if (light.X) {
        for (let i = 0; i < Y.length; i++) { X[i] += f * light.X[i]; Y[i] += f * from[i]; Z[i] += f * light.Z[i]; }
      } else {
        const fx = f * light.x, fz = f * light.z;
        for (let i = 0; i < Y.length; i++) { const l = from[i]; X[i] += fx * l; Y[i] += f * l; Z[i] += fz * l; }
      }
    });
  }

  draw(factors, groups, adapts) {
    this.mix(factors);
    if (this.white === null || adapts) this.white = automaticWhite(this.Y);
    const sceneWhite = [0, 1, 2].map((axis) => groups.reduce((sum, g, k) => sum + factors[k] * g.xyz[axis], 0));
    const white = sceneWhite[1] > 0 ? sceneWhite : [1, 1, 1];
    paintLight(this.X, this.Y, this.Z, displayMatrix(white, this.white), this.dither, this.image.data);
    this.context.putImageData(this.image, 0, 0);
  }
}

class Report {
  constructor(data) {
    this.data = data;
    this.start = data.groups.map((g) => g.start);
    this.factors = [...this.start];
    this.plans = [];
    this.views = [];
    this.adapts = false;
    this.main = document.getElementById("main");
  }

  moved() { return this.factors.some((f, g) => f !== this.start[g]); }

  section(title, id) {
    const section = el("section", { id }, el("h2", {}, title));
    this.main.append(section);
    return section;
  }

  build() {
    const { data } = this;
    document.getElementById("title").textContent = data.title;
    document.getElementById("subtitle").textContent =
      `Lighting report by ${data.inputs.program}` + (data.inputs.file ? `, of ${data.inputs.file}` : "");
    this.buildLights();
    this.summary = el("div", { class: "summary" });
    this.state = el("p", { class: "print-only note" });
    this.main.append(this.summary, this.state);
    this.buildPictures();
    this.buildResults();
    this.buildRequirements();
    this.buildLuminaires();
    this.buildGlare();
    this.buildEnergy();
    this.buildInputs();
    this.update();
  }

  buildLights() {
    const form = document.getElementById("lights"), { groups } = this.data;
    if (groups.length === 0) return;
    this.sliders = groups.map((group, g) => {
      const id = `light-${g}`, output = el("output", { for: id });
      const slider = el("input", { type: "range", id, min: 0, max: Math.max(100, Math.ceil(100 * group.start)), step: 1 });
      slider.addEventListener("input", () => { this.factors[g] = slider.valueAsNumber / 100; this.later(); });
      form.append(el("div", { class: "row" }, el("label", { for: id }, group.name), slider, output));
      return { slider, output };
    });
    const button = (text, factors) => {
      const b = el("button", { type: "button" }, text);
      b.addEventListener("click", () => { this.factors = factors(); this.later(); });
      return b;
    };
    const adapts = el("input", { type: "checkbox", id: "adapts" });
    adapts.addEventListener("change", () => { this.adapts = adapts.checked; this.views.forEach((v) => { v.white = this.adapts ? null : v.firstWhite; }); this.later(); });
    form.append(el("div", { class: "buttons" }, button("As reported", () => [...this.start]), button("All full", () => this.start.map(() => 1)),
      button("All off", () => this.start.map(() => 0)), el("label", { for: "adapts" }, adapts, " pictures' exposure follows the light")));
    this.status = el("p", { class: "status", role: "status" });
    form.append(this.status);
    form.addEventListener("submit", (event) => event.preventDefault());
    form.hidden = false;
  }

  // Once a frame, however fast a slider moves.
  later() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => { this.waiting = false; this.update(); });
  }

  buildPictures() {
    const { pictures } = this.data;
    if (pictures.length === 0 || this.data.groups.length === 0) return;
    const section = this.section("Pictures", "pictures");
    for (const picture of pictures) {
      const view = new ViewPicture(picture, picture.lights);
      view.words = el("figcaption");
      view.name = picture.name;
      section.append(el("figure", {}, view.canvas, view.words));
      this.views.push(view);
    }
  }

  buildResults() {
    const section = this.section("Illuminance", "results"), { targets, groups } = this.data;
    const receivers = targets.filter((t) => t.kind !== "surface");
    if (receivers.length === 0) section.append(el("p", {}, "The zone has no measuring plane and no sensors."));
    this.results = receivers.map((target) => {
      const box = el("div");
      section.append(el("h3", {}, `${target.kind === "plane" ? "Plane" : "Sensors"}: ${target.name}`));
      if (target.plan && groups.length > 0 && target.values[0].length > 0) {
        const first = figuresOf(target, this.start), full = figuresOf(target, this.start.map((s) => (s > 0 ? s : 1)));
        const picture = new PlanPicture(target, this.data.colours, roundScale(first.max > 0 ? first.max : full.max));
        picture.canvas.setAttribute("role", "img");
        picture.canvas.setAttribute("aria-label", `Plan of ${target.name} with isolines of illuminance`);
        this.plans.push({ target, picture });
        section.append(el("figure", {}, picture.canvas, el("figcaption", {}, "Illuminance, lx: colours and isolines. " +
          (target.plan.luminaires.length > MOST_NUMBERED ? "Orange: luminaires." : "Numbers: luminaires, as in the schedule."))));
      }
      section.append(box);
      if (target.left_out > 0) section.append(el("p", { class: "note" },
        `${plural(target.left_out, "point")} of ${target.points} left out: no light of the room comes to where they are (in furniture, or outside).`));
      return { target, box };
    });
    section.append(el("p", { class: "note" }, "Light as new, before any maintenance factor. The stated error is what the simulation may be off by at about 95 % of " +
      "points; photometry, reflectances and geometry count as given. After a light is dimmed it is the sum of the groups' own errors, which the error of their light together does not exceed."));
  }

  buildRequirements() {
    const { requirements } = this.data;
    if (!requirements) return;
    const section = this.section("Requirements", "requirements");
    section.append(el("p", {}, (requirements.title ? requirements.title + ": " : "") + requirements.source));
    const factors = [...new Set(this.data.groups.filter((g) => !g.daylight).map((g) => g.kept))];
    this.requirementsBox = el("div");
    section.append(this.requirementsBox, el("p", { class: "note" },
      "Values are of maintained light" + (factors.length > 0 ? ` (maintenance factor ${factors.map((f) => figure(f, 2)).join(", ")}, applied once)` : "") +
      ", by luminaires alone; glare is of the room as new. A result is undecided where the limit lies within the stated error, or the value is not known."));
    for (const finding of requirements.findings) {
      if (finding.what !== "power per 100 lx") continue;
      const target = this.data.targets.find((t) => t.name === finding.where && t.kind !== "surface");
      const kept = this.data.groups.map((g) => (g.daylight ? 0 : g.start * g.kept));
      if (finding.value !== null) finding.installed = finding.value * figuresOf(target, kept).mean / 100;
    }
  }

  buildLuminaires() {
    const section = this.section("Luminaires", "luminaires"), { places } = this.data.luminaires;
    if (places.length === 0) { section.append(el("p", {}, "The room has no luminaires.")); return; }
    section.append(fittingsTable(this.data), el("h3", {}, "Where they are"), placesTable(this.data, MOST_PLACES),
      el("p", { class: "note" }, "Positions of the photometric centres in the zone file's axes."));
  }

  buildGlare() {
    if (this.data.glare.length === 0 || this.data.groups.length === 0) return;
    const section = this.section("Glare", "glare");
    this.glareBox = el("div");
    section.append(this.glareBox, el("p", { class: "note" },
      "Unified glare rating (CIE 117, small sources as CIE 147 has them) by luminaires in sight, of the room as new. Windows and luminaires seen in mirrors are no sources."));
  }

  buildEnergy() {
    const section = this.section("Where the light goes", "energy"), { energy } = this.data;
    if (energy.length === 0) { section.append(el("p", {}, "There is no light.")); return; }
    this.energyBox = el("div");
    const open = Math.max(...energy.map((e) => (e.emitted_W > 0 ? Math.abs(e.open_W / e.emitted_W) : 0)));
    const error = Math.max(...this.data.groups.map((g) => (g.flux_lm > 0 ? g.error_lm / g.flux_lm : 0)));
    section.append(this.energyBox, el("p", {},
      `What the lights emit and what surfaces absorb, what leaves the room and what falls on backs of surfaces agree within ${figure(100 * open, 2)} %. ` +
      `Inter-reflection was followed until what is left out changes the mean by no more than the bound that, with this, makes ${figure(100 * error, 2)} %.`));
  }

  buildInputs() {
    const section = this.section("Made from", "inputs"), { inputs } = this.data;
    const hash = (text) => (text ? el("span", { class: "hash" }, text) : "–");
    const rows = [["Program", inputs.program], ["Luminance database", inputs.file || "–"], ["its content's hash (XXH3, 128 bit)", hash(inputs.hash)],
      ["Ray network's hash", hash(inputs.rays_hash)], ["Requirements file", inputs.requirements || "–"],
      ["Model", `${plural(inputs.surfaces, "surface")}, ${plural(inputs.cells, "cell")}, ${plural(inputs.points, "measuring point")}, ${plural(inputs.bands, "waveband")}`],
      ["Volume", inputs.volume_m3 === null ? "not closed" : figure(inputs.volume_m3, 4) + " m³"]];
    section.append(tableOf([{ name: "What" }, { name: "Which" }], rows));
  }

  update() {
    const { data, factors } = this;
    this.sliders?.forEach(({ slider, output }, g) => {
      slider.value = Math.round(100 * factors[g]);
      output.textContent = `${Number((100 * factors[g]).toFixed(1))} %`;
    });
    this.state.textContent = "Lights: " + (data.groups.map((g, k) => `${g.name} ${Number((100 * factors[k]).toFixed(1))} %`).join(", ") || "none");
    for (const view of this.views) {
      view.draw(factors, data.groups, this.adapts);
      view.firstWhite ??= view.white;
      view.words.textContent = `View ${view.name}: ${figure(view.white)} cd/m² shown as white, highlights rolled off`;
    }
    for (const { target, picture } of this.plans) picture.draw(figuresOf(target, factors).lx);
    for (const { target, box } of this.results) box.replaceChildren(planeFigures(figuresOf(target, factors)));
    this.energyBox?.replaceChildren(energyTable(data, factors));
    this.glareBox?.replaceChildren(this.glareTable());
    this.judge();
  }

  glareTable() {
    const rows = this.data.glare.map((rating) => {
      const { ugr, eye } = worstUgr(rating, this.factors);
      const about = rating.kind === "view" ? "as the view looks" : eye < 0 ? `eyes ${rating.height_m} m above the floor`
        : `worst of ${plural(rating.sums[0].length / rating.directions, "eye")} ${rating.height_m} m above the floor, looking ` +
          `${figure(360 * (eye % rating.directions) / rating.directions)}° from +x towards +y`;
      return [`${rating.kind === "view" ? "View" : "Plane"} ${rating.name}`, about, Number.isFinite(ugr) ? ugr.toFixed(1) : "no source in sight"];
    });
    return tableOf([{ name: "Seen from" }, { name: "Eye" }, { name: "UGR", numbers: true }], rows);
  }

  judge() {
    const { data, factors } = this, moved = this.moved();
    const items = [];
    if (data.requirements) {
      const findings = data.requirements.findings.map((finding) => {
        const asReported = { ...finding, follows: true };
        return { finding, now: moved ? findingFor(finding, data, factors) : asReported };
      });
      this.requirementsBox.replaceChildren(requirementsTable(findings, moved));
      for (const verdict of ["met", "not met", "undecided"])
        items.push([findings.filter(({ now }) => now.verdict === verdict).length, verdict, "verdict " + verdict.replace(" ", "-")]);
    }
    for (const { target } of this.results.slice(0, 1)) {
      const f = figuresOf(target, factors);
      items.push([withUnit(figure(f.mean, 4), "lx"), `mean on ${target.name}`], [ratio(f.u0), "U0 there"]);
    }
    if (this.status) this.status.textContent = items.map(([big, small]) => `${big} ${small}`).join(" · ");
    const watts = data.groups.reduce((sum, g) => (g.daylight ? sum : g.watts === null ? NaN : sum + g.watts), 0);
    if (data.luminaires.places.length > 0) items.push([plural(data.luminaires.places.length, "luminaire"), Number.isFinite(watts) ? `${figure(watts, 4)} W installed` : "power not known"]);
    this.summary.replaceChildren(...items.map(([big, small, style]) => el("div", {}, el("b", { class: style ?? "" }, String(big)), small)));
  }
}

(async () => {
  const data = JSON.parse(document.getElementById("data").textContent);
  try {
    await unpackRoom(data);
    for (const picture of data.pictures)
      picture.lights = await Promise.all(picture.groups.map((part) => unpackPicture(part, picture.width, picture.height)));
    globalThis.report = new Report(data);
    report.build();
    document.documentElement.dataset.ready = "yes";
  } catch (error) {
    document.getElementById("main").append(el("p", {}, `This browser cannot show the report: ${error.message}`));
    throw error;
  }
})();
