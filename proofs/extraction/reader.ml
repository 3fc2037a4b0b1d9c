(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Reads certificates (include/dyadel/certificate.h) and hands their sites and legal pairs to the extracted checker.
   Nothing proves this file: it turns text into the numbers written there, and chooses the unit, which cannot make a
   wrong answer.
   Usage: checker FILE...   (exit status 1 when a certificate is rejected) *)
open Checker

exception Bad of string

(* ---- numbers ---- *)

let rec positive_of_int n = if n = 1 then XH else if n land 1 = 1 then XI (positive_of_int (n / 2)) else XO (positive_of_int (n / 2))
let of_int n = if n = 0 then Z0 else if n > 0 then Zpos (positive_of_int n) else Zneg (positive_of_int (-n))

(* Fifteen digits at a time. *)
let of_digits text =
  let chunk = 15 in
  let rec power k = if k = 0 then 1 else 10 * power (k - 1) in
  let rec go acc from =
    if from >= String.length text then acc
    else
      let n = min chunk (String.length text - from) in
      let part = String.sub text from n in
      String.iter (fun c -> if c < '0' || c > '9' then raise (Bad ("digits: " ^ text))) part;
      go (Z.add (Z.mul acc (of_int (power n))) (of_int (int_of_string ("0u" ^ part)))) (from + n)
  in
  if text = "" then raise (Bad "no digits") else go Z0 0

let of_text text =
  if text <> "" && text.[0] = '-' then Z.opp (of_digits (String.sub text 1 (String.length text - 1))) else of_digits text

(* m or m*2^e *)
let number text =
  match String.index_opt text '*' with
  | None -> { man = of_text text; expo = Z0; den = Zpos XH }
  | Some k ->
    let e = String.sub text (k + 3) (String.length text - k - 3) in
    { man = of_text (String.sub text 0 k); expo = of_int (int_of_string e); den = Zpos XH }

let split_at text k = (String.sub text 0 k, String.sub text (k + 1) (String.length text - k - 1))

(* man 2^expo of the sum of two numbers *)
let sum a b =
  let e = Z.min a.expo b.expo in
  let shifted n = Z.shiftl n.man (Z.add n.expo (Z.opp e)) in
  { man = Z.add (shifted a) (shifted b); expo = e; den = Zpos XH }

(* The two ends of a side: lo, lo/d or lo+w. *)
let side text =
  match (String.index_opt text '/', String.index_opt text '+') with
  | Some k, _ ->
    let lo, d = split_at text k in
    let n = { (number lo) with den = of_text d } in
    (n, n)
  | None, Some k ->
    let lo, w = split_at text k in
    (number lo, sum (number lo) (number w))
  | None, None -> (number text, number text)

(* ---- lines ---- *)

let words line = String.split_on_char ' ' line

let read_certificate channel =
  let line () = try input_line channel with End_of_file -> raise (Bad "too short") in
  let rec heading name =
    match words (line ()) with [ w; count ] when w = name -> int_of_string count | _ -> heading name
  in
  let sites =
    List.init (heading "sites") (fun k -> (k, words (line ())))
    |> List.filter_map (function
         | _, "=" :: _ -> None
         | k, [ x; y ] ->
           let left, right = side x and low, high = side y in
           Some { name = of_int k; left; right; low; high }
         | _ -> raise (Bad "site"))
  in
  let edges =
    List.init (heading "legal") (fun _ ->
        match words (line ()) with
        | [ i; j; x; y ] -> { from = of_text i; to0 = of_text j; at_x = number x; at_y = number y }
        | _ -> raise (Bad "legal pair"))
  in
  (sites, edges)

(* ---- the unit ---- *)

let numbers sites edges =
  List.concat_map (fun s -> [ s.left; s.right; s.low; s.high ]) sites
  @ List.concat_map (fun e -> [ e.at_x; e.at_y ]) edges

let unit_of sites edges =
  let all = numbers sites edges in
  ( List.fold_left (fun d n -> if n.den = Zpos XH then d else Z.lcm d n.den) (Zpos XH) all,
    List.fold_left (fun e n -> Z.max e (Z.opp n.expo)) Z0 all )

let verdict name =
  let channel = open_in_bin name in
  let answer =
    try
      let sites, edges = read_certificate channel in
      let d, e = unit_of sites edges in
      let good = check d e sites edges in
      Printf.printf "%s: %s, %d sites, %d legal pairs\n%!" name
        (if good then "accepted" else "rejected")
        (List.length sites) (List.length edges);
      good
    with Bad _ | Failure _ | Invalid_argument _ | Sys_error _ ->
      Printf.printf "%s: rejected, no certificate\n" name;
      false
  in
  close_in channel;
  answer

let () = exit (if List.for_all Fun.id (List.map verdict (List.tl (Array.to_list Sys.argv))) then 0 else 1)
