(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* When the checker finds the certificate complete and its bounds kept, the region of all possible pairs measures at most
   the one, and is within the other of every true graph. *)
From Coq Require Import Reals Lra Lia Psatz ZArith List Bool.
From Dyadel Require Import Plane Distance Cells Legal Nerve Orientation Crossing Bounds Measure AreaHull.
From Dyadel Require Import Checker CheckerSound CheckerFaces CheckerComplete CheckerBounds.
Import ListNotations.
Open Scope R_scope.

(* ---- numbers ---- *)

Lemma at_most_value D E z n : (0 < D)%Z -> at_most D E z n = true -> IZR z <= unit D E * unit D E * value n.
Proof.
  intros P H. unfold at_most in H. cbv zeta in H. apply andb_true_iff in H. destruct H as [Q H].
  apply Z.ltb_lt in Q. apply Z.leb_le, IZR_le in H. rewrite !shift_value, !mult_IZR in H by lia.
  set (k := (expo n + 2 * E)%Z) in *. apply IZR_lt in Q.
  assert (T : forall e, 0 < powerRZ 2 e) by (intros; apply powerRZ_lt; lra).
  assert (K : powerRZ 2 (Z.max 0 k) = powerRZ 2 k * powerRZ 2 (Z.max 0 (- k))).
  { rewrite <- powerRZ_add by lra. f_equal. lia. }
  rewrite K in H. unfold k in H. replace (2 * E)%Z with (E + E)%Z in H by ring. rewrite !powerRZ_add in H by lra.
  pose proof (T (Z.max 0 (- (expo n + (E + E))))%Z) as T0. pose proof (T E). pose proof (T (expo n)).
  assert (G : IZR z * IZR (den n) <= IZR (man n) * (IZR D * IZR D) * (powerRZ 2 (expo n) * (powerRZ 2 E * powerRZ 2 E))).
  { apply (Rmult_le_reg_r _ _ _ T0). eapply Rle_trans; [exact H |]. right. ring. }
  apply (Rmult_le_reg_r _ _ _ Q). eapply Rle_trans; [exact G |]. right. unfold unit, value. field. lra.
Qed.

Lemma max_scaled S a b za zb : 0 <= S -> IZR za = S * a -> IZR zb = S * b -> IZR (Z.max za zb) = S * Rmax a b.
Proof.
  intros P A C. rewrite <- RmaxRmult by exact P. rewrite <- A, <- C.
  destruct (Z.max_spec za zb) as [[H ->] | [H ->]]; [apply IZR_lt in H; now rewrite Rmax_right by lra |].
  apply IZR_le in H. now rewrite Rmax_left by lra.
Qed.

Lemma min_scaled S a b za zb : 0 < S -> IZR za = S * a -> IZR zb = S * b -> IZR (Z.min za zb) = S * Rmin a b.
Proof.
  intros P A C. destruct (Z.min_spec za zb) as [[H ->] | [H ->]]; [apply IZR_lt in H | apply IZR_le in H];
    rewrite A, C in H; [apply Rmult_lt_reg_l in H | apply Rmult_le_reg_l in H]; try exact P.
  - now rewrite Rmin_left by lra.
  - now rewrite Rmin_right by lra.
Qed.

(* ---- one pair ---- *)

Lemma hull_twice_value S a b A B : 0 < S -> is_box S a A -> is_box S b B ->
  IZR (hull_twice a b) = S * S * hull_area2 A B.
Proof.
  intros P (AX0 & AX1 & AY0 & AY1) (BX0 & BX1 & BY0 & BY1). assert (Q : 0 <= S * S) by nra.
  unfold hull_twice, hull_area2, legs_ll, legs_lr, legs_ul, legs_ur. rewrite !minus_IZR, !mult_IZR, !minus_IZR.
  rewrite (max_scaled S (xhi A) (xhi B)) by lra. rewrite (max_scaled S (yhi A) (yhi B)) by lra.
  rewrite (min_scaled S (xlo A) (xlo B)) by lra. rewrite (min_scaled S (ylo A) (ylo B)) by lra.
  rewrite (max_scaled (S * S) 0 (- ((xlo B - xlo A) * (ylo B - ylo A)))) by
    (try assumption; rewrite ?opp_IZR, ?mult_IZR, ?minus_IZR, ?AX0, ?BX0, ?AY0, ?BY0; ring).
  rewrite (max_scaled (S * S) 0 ((xhi B - xhi A) * (ylo B - ylo A))) by
    (try assumption; rewrite ?mult_IZR, ?minus_IZR, ?AX1, ?BX1, ?AY0, ?BY0; ring).
  rewrite (max_scaled (S * S) 0 ((xlo B - xlo A) * (yhi B - yhi A))) by
    (try assumption; rewrite ?mult_IZR, ?minus_IZR, ?AX0, ?BX0, ?AY1, ?BY1; ring).
  rewrite (max_scaled (S * S) 0 (- ((xhi B - xhi A) * (yhi B - yhi A)))) by
    (try assumption; rewrite ?opp_IZR, ?mult_IZR, ?minus_IZR, ?AX1, ?BX1, ?AY1, ?BY1; ring).
  ring.
Qed.

Lemma diameter_value S b A v : 0 < S -> is_box S b A -> 0 <= v -> IZR (diameter2 b) <= S * S * (v * v) -> diameter_le A v.
Proof.
  intros P (X0 & X1 & Y0 & Y1) V H x y [Xx Xy] [Yx Yy]. unfold diameter2 in H. cbv zeta in H.
  rewrite plus_IZR, !mult_IZR, !minus_IZR, X0, X1, Y0, Y1 in H.
  assert (G : (xhi A - xlo A) * (xhi A - xlo A) + (yhi A - ylo A) * (yhi A - ylo A) <= v * v).
  { apply (Rmult_le_reg_l (S * S)); [nra |]. lra. }
  assert (U1 : (fst x - fst y) * (fst x - fst y) <= (xhi A - xlo A) * (xhi A - xlo A)) by (apply square_le; lra).
  assert (U2 : (snd x - snd y) * (snd x - snd y) <= (yhi A - ylo A) * (yhi A - ylo A)) by (apply square_le; lra).
  pose proof (dist_sq x y) as Q. pose proof (dist_nonneg x y). unfold dist2 in Q. apply Rnot_lt_le. intros L. nra.
Qed.

(* ---- all pairs ---- *)

Section Complete.
Variables (D E : Z) (l : list site) (edges : list edge) (B : sites).
Variables (triangles : list triangle) (corners : list corner) (fans : list fan).
Variable accepted : check D E l edges = true.
Variable described : describes l B.
Variable complete : all_surrounded l edges (surrounded D E l edges triangles corners fans) = true.
Variable bs : list box.
Variable scale : scaled_sites D E l = Some bs.
Variable bound : number.

Notation N := (length l).
Notation by_name := (index box_name bs).
Definition places_of (e : edge) : nat * nat := (position bs (from e), position bs (to e)).

Lemma sized : (0 < D)%Z /\ 0 < unit D E.
Proof. pose proof (positive_scale D E l edges accepted) as P. split; [exact P | now apply unit_pos]. Qed.

Lemma box_at_place i b : Map.find i by_name = Some b -> is_box (unit D E) b (B (position bs i)).
Proof.
  intros H. apply (sought_box D E l edges accepted bs scale) in H.
  exact (proj1 (found_box D E l edges B accepted described bs scale i b H)).
Qed.

Lemma possible_listed i j : (i < N)%nat -> (j < N)%nat -> i <> j -> possible N B i j ->
  exists e, In e edges /\ (places_of e = (i, j) \/ places_of e = (j, i)).
Proof.
  intros I J M P. destruct (nth_error l i) as [si |] eqn:Si; [| apply nth_error_None in Si; lia].
  destruct (nth_error l j) as [sj |] eqn:Sj; [| apply nth_error_None in Sj; lia].
  assert (A : named l i (name si)) by now exists si. assert (C : named l j (name sj)) by now exists sj.
  destruct (named_box D E l edges B accepted described bs scale i _ A) as (_ & _ & _ & _ & Pi).
  destruct (named_box D E l edges B accepted described bs scale j _ C) as (_ & _ & _ & _ & Pj).
  destruct (proj1 (decided_exact D E l edges B triangles corners fans i j _ _ accepted described complete A C M) P)
    as [e [Ie Q]].
  exists e. split; [exact Ie |]. unfold places_of. destruct Q as [[-> ->] | [-> ->]]; rewrite Pi, Pj; tauto.
Qed.

Lemma area_onto_sum some before z : area_onto by_name some before = Some z ->
  IZR z = IZR before + unit D E * unit D E * (2 * hull_areas B (map places_of some)).
Proof.
  revert before. induction some as [| e some IH]; intros before H; simpl in H.
  - injection H as <-. simpl. ring.
  - destruct (Map.find (from e) by_name) as [a |] eqn:A; [| discriminate].
    destruct (Map.find (to e) by_name) as [b |] eqn:C; [| discriminate]. apply IH in H. rewrite H, plus_IZR.
    rewrite (hull_twice_value (unit D E) a b _ _ (proj2 sized) (box_at_place _ _ A) (box_at_place _ _ C)).
    simpl. unfold hull_area. field.
Qed.

Lemma area_kept : area_holds D E l edges bound = true -> measure_le (possible_region N B) (value bound).
Proof.
  intros H. unfold area_holds in H. rewrite scale in H. destruct (area_onto by_name edges 0) as [z |] eqn:Q; [| discriminate].
  destruct sized as [P U]. apply (at_most_value _ _ _ _ P) in H. apply area_onto_sum in Q.
  assert (V : value (Number (2 * man bound) (expo bound) (den bound)) = 2 * value bound).
  { unfold value. cbn [man expo den]. rewrite mult_IZR. unfold Rdiv. ring. }
  apply (measure_subset _ (possible_region N B) (hull_areas B (map places_of edges)) _); [now intros | |].
  - rewrite V, Q in H. assert (U2 : 0 < unit D E * unit D E) by nra. apply (Rmult_le_reg_l _ _ _ U2). lra.
  - apply triangulation_area. intros i j I J M Pij.
    destruct (possible_listed i j I J M Pij) as [e [Ie [W | W]]]; [left | right]; apply in_map_iff; now exists e.
Qed.

Lemma within_is_diameter i : (0 <= man bound)%Z -> (0 < den bound)%Z ->
  is_within D E by_name (Number (man bound * man bound) (2 * expo bound) (den bound * den bound)) i = true ->
  diameter_le (B (position bs i)) (value bound).
Proof.
  intros M P H. unfold is_within in H. destruct (Map.find i by_name) as [b |] eqn:F; [| discriminate].
  destruct sized as [Q U]. apply (at_most_value _ _ _ _ Q) in H. apply IZR_le in M. apply IZR_lt in P.
  pose proof (powerRZ_lt 2 (expo bound) ltac:(lra)) as T.
  apply (diameter_value (unit D E) b _ _ U (box_at_place i b F)).
  - unfold value. apply Rle_mult_inv_pos; [| exact P]. apply Rmult_le_pos; lra.
  - replace (value bound * value bound)
      with (value (Number (man bound * man bound) (2 * expo bound) (den bound * den bound))); [exact H |].
    unfold value. cbn [man expo den]. replace (2 * expo bound)%Z with (expo bound + expo bound)%Z by ring.
    rewrite !mult_IZR, powerRZ_add by lra. field. lra.
Qed.

Lemma hausdorff_kept p : hausdorff_holds D E l edges bound = true -> choice N B p ->
  (forall z, graph N p z -> possible_region N B z) /\
  (forall z, possible_region N B z -> exists w, graph N p w /\ dist z w <= value bound).
Proof.
  intros H P. unfold hausdorff_holds in H. rewrite scale in H. cbv zeta in H. rewrite !andb_true_iff, forallb_forall in H.
  destruct H as [[M Q] H]. apply Z.leb_le in M. apply Z.ltb_lt in Q.
  apply triangulation_hausdorff; [exact P |]. intros i j I J N0 W. exists (value bound).
  destruct (possible_listed i j I J N0 W) as [e [Ie G]]. specialize (H e Ie). apply andb_true_iff in H. destruct H as [H1 H2].
  apply (within_is_diameter _ M Q) in H1, H2.
  assert (L : legal N B (position bs (from e)) (position bs (to e))).
  { destruct (accepted_names D E l edges B accepted described e Ie) as [[a A] [b C]].
    destruct (named_box D E l edges B accepted described bs scale a _ A) as (_ & _ & _ & _ & Pa).
    destruct (named_box D E l edges B accepted described bs scale b _ C) as (_ & _ & _ & _ & Pb).
    rewrite Pa, Pb. eexists. exact (accepted_witness D E l edges B accepted described e a b Ie A C). }
  unfold places_of in G. destruct G as [G | G]; injection G as G1 G2; rewrite G1 in *; rewrite G2 in *.
  - split; [exact H1 |]. split; [exact H2 |]. left. split; [exact L | lra].
  - split; [exact H2 |]. split; [exact H1 |]. left. split; [| lra].
    destruct L as [c L]. exists c. now apply witness_sym.
Qed.

End Complete.

(* The bound of the area: the region of all possible pairs measures at most so much. *)
Theorem accepted_area D E l edges B triangles corners fans bound :
  check D E l edges = true -> describes l B -> all_surrounded l edges (surrounded D E l edges triangles corners fans) = true ->
  area_holds D E l edges bound = true -> measure_le (possible_region (length l) B) (value bound).
Proof.
  intros C F G H. destruct (accepted_parts D E l edges C) as (bs & S & _).
  exact (area_kept D E l edges B triangles corners fans C F G bs S bound H).
Qed.

(* The bound of the Hausdorff distance: the true graph of every choice is in that region, which is nowhere farther from it. *)
Theorem accepted_hausdorff D E l edges B triangles corners fans bound p :
  check D E l edges = true -> describes l B -> all_surrounded l edges (surrounded D E l edges triangles corners fans) = true ->
  hausdorff_holds D E l edges bound = true -> choice (length l) B p ->
  (forall z, graph (length l) p z -> possible_region (length l) B z) /\
  (forall z, possible_region (length l) B z -> exists w, graph (length l) p w /\ dist z w <= value bound).
Proof.
  intros C F G H P. destruct (accepted_parts D E l edges C) as (bs & S & _).
  exact (hausdorff_kept D E l edges B triangles corners fans C F G bs S bound p H P).
Qed.
