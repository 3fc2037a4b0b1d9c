(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* dyadel-proved FILE [--still LIST]: checks a certificate by the checker that is proved in Coq (theories/Checker.v,
   CheckerFaces.v), and reports the parts proved by it and the others, as `dyadel verify` does. LIST: sites, a line
   each, that the caller says stay where they are: nothing narrows them; without LIST, points do. Exit status 0: all
   statements are proved; 3: accepted, but something is not proved, and named; 1: rejected. "-" is standard input. *)
open Source
open Reader

let whole_file name =
  let channel = if name = "-" then stdin else open_in_bin name in
  let text = Buffer.create 65536 in
  let rec fill () = match Buffer.add_channel text channel 65536 with () -> fill () | exception End_of_file -> () in
  fill ();
  close_in channel;
  Buffer.contents text

(* The line of the first pair whose point is not a witness; that of the first pair when the sites are at fault. *)
let line_at_fault c d e =
  match Checker.scaled_sites d e c.sites with
  | None -> c.first_edge - 1
  | Some boxes ->
    let good = Checker.check_edge d e (Checker.index (fun b -> b.Checker.box_name) boxes) (Checker.build Checker.deepest boxes) in
    let rec first k = function [] -> c.first_edge - 1 | edge :: rest -> if good edge then first (k + 1) rest else k in
    first c.first_edge c.edges

let check_chains c d e =
  let broken = Checker.broken_chains d e c.sites (List.map snd c.pairs.chains) in
  let refuse (line, (chain : Checker.chain)) =
    let name = Z.to_string in
    if List.memq chain broken then
      raise (Bad (line, Printf.sprintf "the chain does not prove that %s %s is illegal" (name chain.one) (name chain.other)))
  in
  if broken <> [] then List.iter refuse (List.rev c.pairs.chains)

(* Its own unit: vertices have more digits than all else. *)
let check_diagram c (g : Reader.diagram) =
  let vertex (p : Checker.polygon) (at_x, at_y) = { Checker.from = p.owner; to0 = p.owner; at_x; at_y } in
  let vertices = List.concat_map (fun (p : Checker.polygon) -> List.rev_map (vertex p) p.vertices) g.polygons in
  let d, e = Hints.unit_of (g.window :: c.sites) vertices [] in
  if not (Checker.undetermined_holds d e c.sites g.window g.polygons g.undetermined) then
    raise (Bad (g.first_polygon,
      if Checker.polygons_hold d e c.sites g.window g.polygons then "the polygons leave a greater area"
      else "polygons are not in order, strictly convex, within a window that has an area, and surely nearest to their sites"))

(* The least number whose square is at least z. *)
let root_above z = if Z.sign z <= 0 then Z.zero else Z.succ (Z.sqrt (Z.pred z))

let window_bits = 40
let effort_bits = 18

(* Do boxes prove the distance? Its own unit: the window is about 2^40 of it, in rough numbers. First with all digits and
   without a cut, where the bound reaches across all. *)
let check_distance c (g : Reader.diagram) bound =
  let d, e = Hints.unit_of (g.window :: c.sites) [] [] in
  let bits = match Checker.scaled_sites d e [ g.window ] with
    | Some [ w ] -> Z.numbits (Z.max (Z.sub w.x1 w.x0) (Z.sub w.y1 w.y0))
    | _ -> window_bits
  in
  let e = Z.add e (Z.of_int (max 0 (window_bits - bits))) in
  let holds k effort = Checker.distance_holds root_above k effort d e c.sites g.window bound in
  let effort = Z.shift_left (Z.of_int (List.length c.sites + 64)) effort_bits in
  if not (holds Z.zero Z.zero || holds (Z.of_int (max 0 (bits - window_bits))) effort) then
    raise (Bad (g.distance_line, "boxes do not prove the bound of the distance"))

(* What of the pairs is proved. *)
type proof = {
  decided : bool;  (* all possible pairs are legal ones that are listed *)
  complete : bool;  (* all possible pairs are listed *)
  surrounded : int;  (* sites *)
  faces : int;  (* sure triangles to surround them *)
  covering : int;  (* triangles that cover the plane *)
  fixed : bool;  (* nothing that is narrowed changes what a pair is *)
  loose : int;  (* ties that are not shown to be ties *)
  counted : bool;  (* are corners and the other numbers of the section right? They say nothing of pairs. *)
}

let listed c = List.rev_append c.pairs.listed c.edges

(* And by how many triangles: there are four at first, and each cut makes one more. *)
let is_covered c d e boxes found =
  let whole, k = Cuts.extent boxes in
  let v = Cuts.view_of whole k in
  let triangles = ref 4 in
  let cut p q r = incr triangles; Cuts.cut v p q r in
  let covered = Checker.all_covered cut (Z.of_int k) (Cuts.effort boxes) v.o d e c.sites (listed c) found in
  (covered, !triangles)

(* The pairs that are shown to be ties neither by circles of exact points nor by what blocks say. *)
let loose_pairs c d e boxes (b : Blocks.proof) pairs =
  let sets = List.mapi (fun k g -> (Z.of_int k, g)) b.sets in
  Checker.loose_of_sets Blocks.most d e c.sites sets (Crossings.hint boxes sets)
    (Checker.loose_ties d e c.sites (Circles.hint boxes c.edges) pairs)

let proof_of c d e b still =
  let boxes = Option.get (Checker.scaled_sites d e c.sites) in
  let triangles, fans = Hints.triangles_and_fans boxes c.edges in
  let found = Checker.surrounded d e c.sites c.edges triangles c.corners fans in
  let decided = Checker.all_surrounded c.sites c.edges found in
  let covered, covering = if decided || c.capped then (false, 0) else is_covered c d e boxes found in
  let complete = decided || covered in
  let are_sure () = List.length (Checker.sure_triangles d e c.sites c.edges triangles) = c.pairs.faces in
  let are_corners () = List.length (Checker.sure_corners d e c.sites c.corners) = List.length c.corners in
  let p = c.pairs in
  let around = Hashtbl.create 1000 in
  List.iter (fun (f : Checker.fan) -> Hashtbl.replace around f.centre ()) found;
  let is_open i j = not (Hashtbl.mem around i || Hashtbl.mem around j) in
  let are_open =
    List.for_all (fun (e : Checker.edge) -> is_open e.from e.to0) p.listed
    && List.for_all (fun (_, (chain : Checker.chain)) -> is_open chain.one chain.other) p.chains
  in
  let counted = are_corners () && (decided || (p.unproved = 0 && are_open && complete && are_sure ())) in
  let loose = List.length (loose_pairs c d e boxes b p.ties) and of_pairs = complete && c.goal = [ "decided" ] in
  let may_change = if of_pairs then loose_pairs c d e boxes b p.listed else [] in
  let fixed = Checker.is_fixpoint d e c.sites still of_pairs c.edges p.listed may_change in
  { decided; complete; covering; fixed; loose; surrounded = List.length found; faces = List.length triangles; counted }

let of_diagram c what = Option.bind c.diagram what

(* Does the bound that the goal is about reach it? *)
let is_reached c =
  let reaches m = function
    | Some n -> Checker.bound_reaches (Z.of_string m) n
    | None -> false
  in
  match c.goal with
  | [ "area"; m ] -> reaches m c.area
  | [ "hausdorff"; m ] -> reaches m c.hausdorff
  | [ "voronoi"; "area"; m ] -> reaches m (of_diagram c (fun g -> Some g.undetermined))
  | [ "voronoi"; "hausdorff"; m ] -> reaches m (of_diagram c (fun g -> g.distance))
  | _ -> false

let has_bounds c = c.area <> None || c.hausdorff <> None

let bounds_hold c d e =
  Option.fold ~none:true ~some:(Checker.area_holds d e c.sites (listed c)) c.area
  && Option.fold ~none:true ~some:(Checker.hausdorff_holds d e c.sites c.edges c.pairs.listed) c.hausdorff

let has_unproved_distance c = Option.fold ~none:false ~some:(fun g -> g.distance_unproved) c.diagram

(* Is the goal about a bound that holds? *)
let goal_holds c p =
  match c.goal with
  | [ "voronoi"; "area"; _ ] -> true
  | [ "voronoi"; "hausdorff"; _ ] -> not (has_unproved_distance c)
  | _ -> p.complete

(* Of what the checker knows nothing about, it proves no outcome. *)
let outcome_is_proved c p =
  c.beside = [] &&
  match c.outcome with
  | "decided" -> p.decided || (p.complete && c.pairs.listed = [])
  | "certified" -> is_reached c && goal_holds c p
  | "fixpoint" -> p.fixed
  | _ -> false

(* What a certificate says that cannot be. *)
let contradiction c d e p =
  let opened = c.pairs.listed <> [] || c.capped in
  if c.outcome = "decided" && opened && c.beside = [] then Some "the outcome is not decided: pairs are open"
  else if c.outcome = "certified" && not (is_reached c) then
    Some "the outcome is not certified: no bound reaches the goal"
  else if p.decided && opened then Some "pairs are listed as open that are illegal"
  else if p.decided && (c.pairs.faces <> p.faces || c.pairs.unproved > 0) then
    Some (Printf.sprintf "there are %d sure triangles" p.faces)
  else if c.capped && has_bounds c then Some "a capped result has no bounds"
  else if not (bounds_hold c d e) then Some "a bound is too small"
  else None

let gaps c p (b : Blocks.proof) =
  let left = List.length c.sites - p.surrounded in
  let beside = List.map (fun what -> "not proved: " ^ what) c.beside in
  let unwitnessed = c.pairs.unwitnessed and loose = Blocks.loose_aliases c b in
  beside @ List.filter_map
    (fun (there, text) -> if there then Some ("not proved: " ^ text) else None)
    [ (not (p.complete || c.capped), Printf.sprintf "that pairs among %d sites which are not listed are illegal" left);
      (unwitnessed > 0, Printf.sprintf "that %d pairs without a witness are legal" unwitnessed);
      (p.loose > 0, Printf.sprintf "that %d pairs are ties" p.loose);
      (loose > 0, Printf.sprintf "that %d aliases of points that are not exact are the same points" loose);
      (has_bounds c && not p.complete, "the bounds of area and Hausdorff distance, as more pairs may be possible");
      (not p.counted, "corners and the numbers of triangles and pairs, which the proof does not need");
      (b.unseen_points > 0, Printf.sprintf "that %d points lie where they are described to be" b.unseen_points);
      (b.unseen_facts > 0, Printf.sprintf "that %d facts on points hold" b.unseen_facts);
      (has_unproved_distance c, "the distance of undetermined points to the Voronoi diagram");
      (not (outcome_is_proved c p), "the outcome " ^ c.outcome);
      (c.sphere, "the projection: that rectangles hold the images of places on a sphere, and what follows for places") ]

let report c p (b : Blocks.proof) given gaps =
  print_endline (if gaps = [] then "accepted, all of it proved" else "accepted, not all of it proved: see what is not proved below");
  Printf.printf "states: outcome %s, goal %s%s\n" c.outcome (String.concat " " c.goal) (if c.capped then ", capped" else "");
  Printf.printf "sites: %d, of which %d aliases\n" (List.length c.sites + c.aliases) c.aliases;
  Printf.printf "checked: %d legal pairs, each by its witness against all sites\n" (List.length c.edges);
  let surrounded = if p.decided then List.length c.sites else p.surrounded in
  Printf.printf "checked: %d sites have no possible pairs but the legal ones\n" surrounded;
  if p.complete && not p.decided then
    Printf.printf "checked: pairs of the other %d sites, by %d triangles that cover the plane\n"
      (List.length c.sites - surrounded) p.covering;
  if c.pairs.chains <> [] then
    Printf.printf "checked: no centre on %d chains is possibly nearest to their sites\n" (List.length c.pairs.chains);
  if p.complete then print_endline "checked: all pairs that are not listed are illegal";
  let tied = List.length c.pairs.ties - p.loose in
  if tied > 0 then Printf.printf "checked: %d ties, weakly Delaunay for every choice and strictly for none\n" tied;
  if p.complete && has_bounds c then print_endline "checked: the bounds of area and Hausdorff distance";
  let report_diagram (g : Reader.diagram) =
    Printf.printf "checked: the undetermined area of the Voronoi diagram, by %d polygons\n" (List.length g.polygons);
    if g.distance <> None && not g.distance_unproved then
      print_endline "checked: the distance of undetermined points to the Voronoi diagram, by boxes"
  in
  Option.iter report_diagram c.diagram;
  if b.points + b.facts > 0 then
    Printf.printf "checked: %d points lie where they are described to be, and %d facts on them hold\n" b.points b.facts;
  if outcome_is_proved c p then Printf.printf "checked: the outcome %s\n" c.outcome;
  Option.iter (fun still -> Printf.printf "given: %d sites stay where they are\n" (List.length still)) given;
  if c.pairs.opened > 0 then Printf.printf "open: %d indeterminate pairs, of which nothing is stated\n" c.pairs.opened;
  if c.capped then print_endline "open: the cap was met, of other pairs nothing is stated";
  if c.hints + c.pairs.boxes > 0 then
    print_endline "not used: places, bridges and the number of pairs that boxes prove, from which nothing follows here";
  List.iter print_endline gaps

exception Bad_list of int * string

(* Of the sites that are said to stay, those whose aliases are, too. *)
let staying c listed =
  let known = Hashtbl.create 1000 and moved = Hashtbl.create 1000 in
  List.iter (fun k -> Hashtbl.replace known k ()) listed;
  List.iter (fun (alias, site) -> if not (Hashtbl.mem known alias) then Hashtbl.replace moved site ()) c.aliased;
  List.map Z.of_int (List.filter (fun k -> not (Hashtbl.mem moved k)) listed)

let read_still c name =
  match still_sites c (whole_file name) with
  | listed -> listed
  | exception Bad (line, message) -> raise (Bad_list (line, message))

(* The exit status of one of nearest sites, of which nothing is proved here. *)
let report_nearest c =
  print_endline "accepted, not all of it proved: see what is not proved below";
  Printf.printf "states: outcome %s, goal nearest\n" c.outcome;
  Printf.printf "sites: %d, of which %d aliases\n" (List.length c.sites + c.aliases) c.aliases;
  List.iter (fun what -> print_endline ("not proved: " ^ what)) c.beside;
  Printf.printf "not proved: the outcome %s\n" c.outcome;
  3

(* The exit status. *)
let verdict_on_pairs c list =
  let given = Option.map (read_still c) list in
  let d, e = Hints.unit_of c.sites c.edges (List.map snd c.pairs.chains) in
  if not (Checker.check d e c.sites c.edges) then
    raise (Bad (line_at_fault c d e, "a point is no witness of its pair, or sites are not rectangles"));
  check_chains c d e;
  Option.iter (check_diagram c) c.diagram;
  Option.iter (fun g -> if not g.distance_unproved then Option.iter (check_distance c g) g.distance) c.diagram;
  let b = Blocks.of_blocks c in
  let p = proof_of c d e b (staying c (Option.value ~default:[] given)) in
  Option.iter (fun wrong -> raise (Bad (2, wrong))) (contradiction c d e p);
  let found = gaps c p b in
  report c p b given found;
  if found = [] then 0 else 3

let verdict name list =
  let c = certificate (whole_file name) in
  if c.goal = [ "nearest" ] then report_nearest c else verdict_on_pairs c list

let check name list =
  match verdict name list with
  | status -> exit status
  | exception Bad (line, message) -> Printf.eprintf "dyadel-proved: %s:%d: rejected: %s\n" name line message; exit 1
  | exception Bad_list (line, message) ->
    Printf.eprintf "dyadel-proved: %s:%d: no list of sites: %s\n" (Option.get list) line message;
    exit 2
  | exception Sys_error message -> Printf.eprintf "dyadel-proved: %s\n" message; exit 1
  | exception (Stack_overflow | Out_of_memory) ->
    Printf.eprintf "dyadel-proved: %s: not known, as memory is exhausted\n" name;
    exit 1

let () =
  match Sys.argv with
  | [| _; name |] -> check name None
  | [| _; name; "--still"; list |] when list <> "-" || name <> "-" -> check name (Some list)
  | _ ->
    prerr_endline "usage: dyadel-proved FILE [--still LIST]";
    exit 2
