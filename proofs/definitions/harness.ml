(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Reads what functions in C said, a line for each vector: NAME INPUT ... = ANSWER (vectors.h), and asks the definitions of
   the theories for the same: a table from names of functions in C to what takes their inputs. *)
module Whole = Z
open Filters

let table : (string, int * (string array -> string)) Hashtbl.t = Hashtbl.create 100

(* Functions in C with the number of their inputs. *)
let define name inputs answer =
  if Hashtbl.mem table name then failwith ("defined twice: " ^ name);
  Hashtbl.replace table name (inputs, answer)

(* ---- inputs: from place k on ---- *)

let double a k = b64_of_bits (Whole.of_string ("0x" ^ a.(k)))

let interval a k = iv_of (double a k) (double a (k + 1))

let box_at a k = box (double a k) (double a (k + 1)) (double a (k + 2)) (double a (k + 3))

let point a k = (double a k, double a (k + 1))

(* Integers: written as such, or as a double that holds a small one. *)
let whole a k = Whole.of_string a.(k)

let rounded a k = Whole.of_float (Int64.float_of_bits (Int64.of_string ("0x" ^ a.(k))))

let flag a k = Whole.sign (rounded a k) > 0

let whole_flag a k = Whole.sign (whole a k) <> 0

(* ---- answers ---- *)

let bits x = if is_nan_double x then "nan" else Whole.format "%016x" (bits_of_b64 x)

let all says list = String.concat " " (List.map says list)

let doubles = all bits

let ends a = doubles (iv_ends a)

let pair (h, l) = doubles [ h; l ]

let integer = Whole.to_string

let integers = all integer

let yes b = if b then "1" else "0"

let maybe says = function Some x -> says x | None -> "none"

(* ---- the run ---- *)

let answer name inputs =
  match Hashtbl.find_opt table name with
  | None -> failwith ("there is no definition of " ^ name)
  | Some (count, _) when count <> Array.length inputs -> failwith ("inputs of " ^ name)
  | Some (_, of_inputs) -> of_inputs inputs

let counted = Hashtbl.create 100

let wrong line =
  match String.split_on_char '=' line with
  | [ left; right ] -> (
    match String.split_on_char ' ' (String.trim left) with
    | name :: inputs ->
      Hashtbl.replace counted name (1 + Option.value ~default:0 (Hashtbl.find_opt counted name));
      let says = answer name (Array.of_list inputs) in
      if says = String.trim right then false
      else (
        Printf.printf "%s, by the definition %s\n" line says;
        true)
    | [] -> failwith "a line without a name")
  | _ -> failwith ("no vector: " ^ line)

(* The first lines on which the definition says something else, how many there are, and how many of each function. *)
let run () =
  let bad = ref 0 in
  (try
     while !bad < 20 do
       if wrong (input_line stdin) then incr bad
     done
   with End_of_file -> ());
  List.iter
    (fun (name, count) -> Printf.printf "%s: %d vectors\n" name count)
    (List.sort compare (List.of_seq (Hashtbl.to_seq counted)));
  Printf.printf "%d differ\n" !bad;
  exit (if !bad > 0 || Hashtbl.length counted = 0 then 1 else 0)
