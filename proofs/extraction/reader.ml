(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Reads a certificate (include/dyadel/certificate.h) into what the extracted checker is about. Nothing proves this file:
   it turns text into the numbers written there, each in its only spelling, and takes nothing else. Of sections that the
   checker does not know it says that they are there. *)
open Source

(* The section of pairs that are not known to be legal. *)
type pairs = {
  mutable listed : Checker.edge list;  (* lines o, t and l; the points mean nothing *)
  mutable ties : Checker.edge list;  (* lines t *)
  mutable opened : int;  (* lines o *)
  mutable unwitnessed : int;  (* lines l *)
  mutable chains : (int * Checker.chain) list;  (* with their lines *)
  mutable boxes : int;  (* pairs that boxes are said to prove *)
  mutable faces : int;  (* sure triangles *)
  mutable unproved : int;
}

(* The statements on the Voronoi diagram. *)
type diagram = {
  window : Checker.site;
  polygons : Checker.polygon list;
  first_polygon : int;  (* its line *)
  undetermined : Checker.number;
  distance : Checker.number option;
  distance_line : int;
  distance_unproved : bool;  (* it is said that boxes do not prove it *)
}

type certificate = {
  outcome : string;
  goal : string list;  (* its words *)
  capped : bool;
  sites : Checker.site list;
  aliases : int;
  edges : Checker.edge list;
  first_edge : int;  (* its line *)
  corners : Checker.corner list;
  hints : int;  (* places and bridges *)
  pairs : pairs;
  area : Checker.number option;
  hausdorff : Checker.number option;
  blocks : Described.block list;
  rects : Checker.site array;  (* of all sites; of aliases, those of their sites *)
  aliased : (int * int) list;  (* aliases of sites that are not exact, and these *)
  diagram : diagram option;
  beside : string list;  (* what sections that the checker does not know are about *)
  sphere : bool;  (* is there a section on a sphere? It is not read *)
}

let limit = 1 lsl 20
let zero : Checker.number = { man = Z.zero; expo = Z.zero; den = Z.one }

(* m or m*2^e *)
let number s text : Checker.number =
  match String.index_opt text '*' with
  | None -> { man = integer s text; expo = Z.zero; den = Z.one }
  | Some k ->
    if not (String.starts_with ~prefix:"*2^" (after text k)) then bad s "%S is not a number m or m*2^e" text;
    let man = integer s (String.sub text 0 k) and expo = small s (after text (k + 3)) in
    if Z.is_even man || expo = 0 || abs expo > limit then bad s "%S is not a number m or m*2^e" text;
    { man; expo = Z.of_int expo; den = Z.one }

(* man 2^(expo - e) *)
let whole (n : Checker.number) e = Z.shift_left n.man (Z.to_int (Z.sub n.expo e))

let sum (a : Checker.number) (b : Checker.number) : Checker.number =
  let e = Z.min a.expo b.expo in
  { man = Z.add (whole a e) (whole b e); expo = e; den = Z.one }

(* The two ends of a side: lo, lo/d or lo+w. *)
let side s text =
  let cut k = (number s (String.sub text 0 k), after text (k + 1)) in
  match (String.index_opt text '/', String.index_opt text '+') with
  | Some k, _ ->
    let lo, d = cut k in
    let den = integer s d in
    if Z.leq den Z.one || Z.is_even den || Z.gcd den lo.man <> Z.one then bad s "%S is no denominator in lowest terms" d;
    let point = { lo with den } in
    (point, point)
  | None, Some k ->
    let lo, w = cut k in
    let width = number s w in
    if Z.sign width.man <= 0 then bad s "%S is not a width" w;
    (lo, sum lo width)
  | None, None ->
    let point = number s text in
    (point, point)

(* ---- sections ---- *)

let read_head s =
  if next s <> "dyadel certificate 1" then bad s "this is no \"dyadel certificate 1\"";
  let outcome =
    match words s with
    | [ "outcome"; (("decided" | "certified" | "fixpoint" | "budget" | "cancelled" | "error") as outcome) ] -> outcome
    | _ -> bad s "\"outcome\" is missing"
  in
  let goal =
    match words s with
    | "goal" :: ([ "decided" | "nearest" ] as goal) -> goal
    | "goal" :: ([ ("area" | "hausdorff"); m ] as goal) | "goal" :: ([ "voronoi"; ("area" | "hausdorff"); m ] as goal) ->
      ignore (small s m);
      goal
    | _ -> bad s "\"goal\" is missing"
  in
  match words s with
  | [ "capped"; (("no" | "yes") as capped) ] -> (outcome, goal, capped = "yes")
  | _ -> bad s "\"capped\" is missing"

(* The sites; of each alias its number, its site, and whether that is exact; the rectangles of all. `known` gets the numbers
   of sites, and whether they are exact. *)
let read_sites s known =
  let rects = Hashtbl.create 1000 in
  let exact k = match Hashtbl.find_opt known k with Some e -> e | None -> bad s "%d is no site, or an alias" k in
  let row k =
    match words s with
    | [ "="; other ] ->
      let other = small s other in
      let is_exact = exact other in
      Hashtbl.add rects k (Hashtbl.find rects other);
      Either.Right (k, other, is_exact)
    | [ x; y ] ->
      let left, right = side s x and low, high = side s y in
      let site = { Checker.name = Z.of_int k; left; right; low; high } in
      Hashtbl.add known k (left = right && low = high);
      Hashtbl.add rects k site;
      Either.Left site
    | _ -> bad s "a site has two sides"
  in
  let sites, aliases = List.partition_map Fun.id (rows s "sites" row) in
  (sites, aliases, Array.init (Hashtbl.length rects) (Hashtbl.find rects))

let site s known text =
  let k = small s text in
  if Hashtbl.mem known k then k else bad s "%s is no site, or an alias" text

let pair s known last i j =
  let i = site s known i and j = site s known j in
  if i >= j then bad s "the second site must have the larger number";
  in_order s last (i, j);
  (i, j)

(* The rows "i j x y" of a section. *)
let read_edges s known name =
  let last = ref (-1, -1) in
  let row _ =
    match words s with
    | [ i; j; x; y ] ->
      let i, j = pair s known last i j in
      { Checker.from = Z.of_int i; to0 = Z.of_int j; at_x = number s x; at_y = number s y }
    | _ -> bad s "a pair has two sites and a point"
  in
  rows s name row

(* The rows "i x y" of a section. *)
let read_points s known name =
  let last = ref (-1) in
  let row _ =
    match words s with
    | [ i; x; y ] ->
      let i = site s known i in
      in_order s last i;
      (Z.of_int i, number s x, number s y)
    | _ -> bad s "a site and a point are missing"
  in
  rows s name row

let direction (vertex, (x : Checker.number), (y : Checker.number)) =
  let e = Z.min x.expo y.expo in
  { Checker.vertex; ux = whole x e; uy = whole y e }

(* After a direction: blocker and point by turns, a blocker, a direction. *)
let read_chain s known (one, other) first_way rest =
  let rec read links = function
    | [ k; x; y ] when links <> [] ->
      let last_blocker = Z.of_int (site s known k) and last_way = (number s x, number s y) in
      { Checker.one; other; first_way; links = List.rev links; last_blocker; last_way }
    | k :: x :: y :: rest -> read ((Z.of_int (site s known k), (number s x, number s y)) :: links) rest
    | _ -> bad s "the chain is too short"
  in
  read [] rest

(* Lines on pairs, and the counts that follow. *)
let read_pairs s known legal =
  let p = { listed = []; ties = []; opened = 0; unwitnessed = 0; chains = []; boxes = 0; faces = 0; unproved = 0 } and last = ref (-1, -1) in
  let not_legal i j =
    let i, j = pair s known last i j in
    if Hashtbl.mem legal (i, j) then bad s "the pair is legal already";
    (Z.of_int i, Z.of_int j)
  in
  let rec counts = function
    | [ "boxes"; n ] -> p.boxes <- count s n; counts (words s)
    | [ "triangles"; t ] -> p.faces <- count s t
    | _ -> bad s "\"triangles\" is missing"
  and lines () =
    match words s with
    | [ (("o" | "t" | "l") as kind); i; j ] ->
      let from, to0 = not_legal i j in
      let pair = { Checker.from; to0; at_x = zero; at_y = zero } in
      p.listed <- pair :: p.listed;
      (match kind with
      | "t" -> p.ties <- pair :: p.ties
      | "o" -> p.opened <- p.opened + 1
      | _ -> p.unwitnessed <- p.unwitnessed + 1);
      lines ()
    | "n" :: i :: j :: x :: y :: chain ->
      let ends = not_legal i j in
      p.chains <- (s.line, read_chain s known ends (number s x, number s y) chain) :: p.chains;
      lines ()
    | line -> counts line
  in
  if next s <> "pairs" then bad s "\"pairs\" is missing";
  lines ();
  match words s with
  | [ "unproved"; u ] -> p.unproved <- count s u; p
  | _ -> bad s "\"unproved\" is missing"

let read_bound s name =
  match words s with
  | [ word; "none" ] when word = name -> None
  | [ word; bound ] when word = name -> Some (number s bound)
  | _ -> bad s "%S is missing" name

(* The rest of a line: coordinates of the vertices. *)
let rec read_vertices s found = function
  | [] when found <> [] -> List.rev found
  | x :: y :: rest -> read_vertices s ((number s x, number s y) :: found) rest
  | _ -> bad s "a vertex is missing"

let read_distance s =
  match words s with
  | [ "distance"; "none" ] -> (None, false)
  | [ "distance"; bound ] -> (Some (number s bound), false)
  | [ "distance"; bound; "unproved" ] -> (Some (number s bound), true)
  | _ -> bad s "\"distance\" is missing"

(* After the line "window". *)
let read_diagram s known corners =
  let window =
    match List.map (number s) corners with
    | [ left; right; low; high ] -> { Checker.name = Z.zero; left; right; low; high }
    | _ -> bad s "a window has four ends"
  in
  if next s <> "polygons" then bad s "\"polygons\" is missing";
  let first_polygon = s.line + 1 in
  let rec polygons found =
    match words s with
    | [ "undetermined"; bound ] -> (List.rev found, number s bound)
    | i :: vertices ->
      polygons ({ Checker.owner = Z.of_int (site s known i); vertices = read_vertices s [] vertices } :: found)
    | [] -> bad s "\"undetermined\" is missing"
  in
  let polygons, undetermined = polygons [] in
  let distance, distance_unproved = read_distance s in
  { window; polygons; first_polygon; undetermined; distance; distance_line = s.line; distance_unproved }

let skip s number =
  for _ = 1 to count s number do ignore (next s) done

let ends s =
  s.line <- s.line + 1;
  if s.at < String.length s.text then bad s "something follows the line \"end\""

(* After the line "discs": the statuses of pairs by the discs, which the checker does not know. *)
let skip_discs s discs =
  skip s discs;
  match words s with
  | [ "refined"; m ] -> skip s m; Printf.sprintf "that %s pairs are legal, or illegal, for points in discs" m
  | _ -> bad s "\"refined\" is missing"

(* What follows the bounds: blocks on what points are; discs, a graph; the diagram; the sphere. *)
let read_rest s known size =
  let ends blocks diagram beside sphere = ends s; (List.rev blocks, diagram, List.rev beside, sphere) in
  let rec skip_all () = if next s <> "end" || s.at < String.length s.text then skip_all () in
  let in_discs = ref false in
  let rec sections blocks beside =
    match words s with
    | [ "end" ] -> ends blocks None beside false
    | "discs" :: discs :: ([] | [ "fixed" ]) -> in_discs := true; sections blocks (skip_discs s discs :: beside)
    | [ "graph"; name; rows ] ->
      skip s rows;
      sections blocks (Printf.sprintf "the graph %s, of which %s edges are listed" name rows :: beside)
    | [ "sphere" ] -> skip_all (); ends blocks None beside true
    | "window" :: corners ->
      let diagram = read_diagram s known corners in
      if next s <> "end" then bad s "\"end\" is missing";
      if !in_discs then ends blocks None ("the diagram of points in discs" :: beside) false
      else ends blocks (Some diagram) beside false
    | [ "algebra"; k ] -> sections (Described.block s size k :: blocks) beside
    | _ -> bad s "this is no section"
  in
  sections [] []

(* Places on a sphere, their radius and number: the checker does not know them. *)
let skip_globe s =
  (match words s with "radius" :: _ -> () | _ -> bad s "\"radius\" is missing");
  match words s with [ "places"; n ] -> skip s n | _ -> bad s "\"places\" is missing"

(* A certificate of nearest sites: the checker knows of the sites only. *)
let read_nearest s (outcome, goal, capped) (sites, aliases, rects) =
  let rec places beside =
    match words s with
    | "discs" :: discs :: ([] | [ "fixed" ]) -> skip s discs; places " for points in discs"
    | [ "sphere" ] -> skip_globe s; places beside
    | [ "nearest"; q ] ->
      skip s q;
      Printf.sprintf "which sites are nearest to %s places%s, and how far they are" q beside
    | _ -> bad s "\"nearest\" is missing"
  in
  let beside = places "" in
  if next s <> "end" then bad s "\"end\" is missing";
  ends s;
  let pairs =
    { listed = []; ties = []; opened = 0; unwitnessed = 0; chains = []; boxes = 0; faces = 0; unproved = 0 } in
  { outcome; goal; capped; sites; aliases = List.length aliases; edges = []; first_edge = s.line; corners = []; hints = 0;
    pairs; area = None; hausdorff = None; blocks = []; rects; aliased = []; diagram = None; beside = [ beside ]; sphere = false }

(* Sites that stay where they are, a line each: rising numbers, aliases among them. *)
let still_sites c text =
  let s = { text; at = 0; line = 0 } and last = ref (-1) in
  let rec read found =
    if s.at = String.length text then List.rev found
    else
      let k = match words s with [ k ] -> small s k | _ -> bad s "a line has one site" in
      if k < 0 || k >= Array.length c.rects then bad s "there is no site %d" k;
      in_order s last k;
      read (k :: found)
  in
  read []

(* What follows the sites of one of pairs. *)
let read_pairs_of s known (outcome, goal, capped) (sites, aliases, rects) =
  let legal = Hashtbl.create 1000 in
  let first_edge = s.line + 2 in
  let edges = read_edges s known "legal" in
  List.iter (fun (e : Checker.edge) -> Hashtbl.replace legal (Z.to_int e.from, Z.to_int e.to0) ()) edges;
  let places = read_points s known "places" in
  let bridges = read_edges s known "bridges" in
  let corners = List.map direction (read_points s known "corners") in
  let pairs = read_pairs s known legal in
  let area = read_bound s "area" in
  let hausdorff = read_bound s "hausdorff" in
  let blocks, diagram, beside, sphere = read_rest s known (Array.length rects) in
  let aliased = List.filter_map (fun (k, other, exact) -> if exact then None else Some (k, other)) aliases in
  let hints = List.length places + List.length bridges in
  { outcome; goal; capped; sites; aliases = List.length aliases; edges; first_edge; corners; hints; pairs; area;
    hausdorff; blocks; rects; aliased; diagram; beside; sphere }

let certificate text =
  let s = { text; at = 0; line = 0 } and known = Hashtbl.create 1000 in
  let head = read_head s in
  let read = match head with _, [ "nearest" ], _ -> read_nearest s | _ -> read_pairs_of s known in
  let sites = read_sites s known in
  read head sites
