(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* When the checker finds the certificate complete and its bounds kept, the region of all possible pairs measures at most
   the one, and is within the other of every true graph. *)
From Coq Require Import Reals Lra Lia Psatz ZArith List Bool.
From Dyadel Require Import Plane Distance Cells Legal Nerve Orientation Crossing Bounds Measure AreaHull.
From Dyadel Require Import Checker CheckerSound CheckerFaces CheckerComplete CheckerCover CheckerCoverSound CheckerBounds.
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

Lemma length_value S a b A C x y : 0 < S -> is_box S a A -> is_box S b C -> inside x A -> inside y C ->
  S * S * dist2 x y <= IZR (length2 a b).
Proof.
  intros P (AX0 & AX1 & AY0 & AY1) (CX0 & CX1 & CY0 & CY1) [Xx Xy] [Yx Yy]. unfold length2. cbv zeta.
  rewrite plus_IZR, !mult_IZR. rewrite (max_scaled S (xhi A - xlo C) (xhi C - xlo A)) by
    (lra || (rewrite minus_IZR, ?AX0, ?AX1, ?CX0, ?CX1; ring)).
  rewrite (max_scaled S (yhi A - ylo C) (yhi C - ylo A)) by (lra || (rewrite minus_IZR, ?AY0, ?AY1, ?CY0, ?CY1; ring)).
  set (u := Rmax (xhi A - xlo C) _). set (v := Rmax (yhi A - ylo C) _).
  assert (U : (fst x - fst y) * (fst x - fst y) <= u * u).
  { apply square_le. left. pose proof (Rmax_l (xhi A - xlo C) (xhi C - xlo A)). pose proof (Rmax_r (xhi A - xlo C) (xhi C - xlo A)).
    fold u in H, H0. lra. }
  assert (V : (snd x - snd y) * (snd x - snd y) <= v * v).
  { apply square_le. left. pose proof (Rmax_l (yhi A - ylo C) (yhi C - ylo A)). pose proof (Rmax_r (yhi A - ylo C) (yhi C - ylo A)).
    fold v in H, H0. lra. }
  unfold dist2. assert (0 < S * S) by nra. nra.
Qed.

Lemma roots_fit_sound l d p q : (0 <= l)%Z -> (0 <= d)%Z -> (0 <= p)%Z -> (0 < q)%Z -> roots_fit l d p q = true ->
  sqrt (IZR l) / 2 + sqrt (IZR d) <= IZR p / IZR q.
Proof.
  intros L D P Q H. unfold roots_fit in H. cbv zeta in H. apply andb_true_iff in H. destruct H as [T H].
  apply Z.leb_le in T, H. apply IZR_le in L, D, P, T, H. apply IZR_lt in Q.
  set (t := (4 * (p * p) - q * q * (l + 4 * d))%Z) in *.
  assert (V : IZR t = 4 * (IZR p * IZR p) - IZR q * IZR q * (IZR l + 4 * IZR d))
    by (unfold t; rewrite minus_IZR, !mult_IZR, plus_IZR, mult_IZR; ring).
  rewrite !mult_IZR in H. set (u := sqrt (IZR l)). set (v := sqrt (IZR d)).
  assert (U2 : u * u = IZR l) by now apply sqrt_sqrt. assert (V2 : v * v = IZR d) by now apply sqrt_sqrt.
  assert (U0 : 0 <= u) by apply sqrt_pos. assert (V0 : 0 <= v) by apply sqrt_pos.
  assert (UV : 0 <= u * v) by now apply Rmult_le_pos. assert (QQ : 0 <= IZR q * IZR q) by nra.
  assert (F : 4 * (IZR q * IZR q) * (u * v) <= IZR t).
  { apply le_of_squares; [exact T |]. rewrite <- U2, <- V2 in H. lra. }
  assert (G : IZR q * (u + 2 * v) <= 2 * IZR p).
  { apply le_of_squares; [lra |]. rewrite V, <- U2, <- V2 in F. lra. }
  apply (Rmult_le_reg_r (IZR q)); [exact Q |]. replace (IZR p / IZR q * IZR q) with (IZR p) by (field; lra). lra.
Qed.

(* ---- all pairs ---- *)

(* Every possible pair is one of these. *)
Definition lists_all (l : list site) (B : sites) (listed : list edge) : Prop :=
  forall a b i j, named l a i -> named l b j -> a <> b -> possible (length l) B a b ->
  exists e, In e listed /\ ((from e = i /\ to e = j) \/ (from e = j /\ to e = i)).

Lemma decided_lists_all D E l edges B triangles corners fans :
  check D E l edges = true -> describes l B -> all_surrounded l edges (surrounded D E l edges triangles corners fans) = true ->
  lists_all l B edges.
Proof.
  intros C F G a b i j A A' M P. exact (proj1 (decided_exact D E l edges B triangles corners fans a b i j C F G A A' M) P).
Qed.

Lemma covered_lists_all D E l edges opened B triangles corners fans hint k effort o :
  check D E l edges = true -> describes l B ->
  all_covered hint k effort o D E l (rev_append opened edges) (surrounded D E l edges triangles corners fans) = true ->
  lists_all l B (rev_append opened edges).
Proof.
  intros C F G a b i j A A' M P.
  exact (covered_complete D E l edges opened B triangles corners fans hint k effort o a b i j C F G A A' M P).
Qed.

Section Complete.
Variables (D E : Z) (l : list site) (edges opened : list edge) (B : sites).
Variable accepted : check D E l edges = true.
Variable described : describes l B.
Notation listed := (rev_append opened edges).
Variable complete : lists_all l B listed.
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
  exists e, In e listed /\ (places_of e = (i, j) \/ places_of e = (j, i)).
Proof.
  intros I J M P. destruct (nth_error l i) as [si |] eqn:Si; [| apply nth_error_None in Si; lia].
  destruct (nth_error l j) as [sj |] eqn:Sj; [| apply nth_error_None in Sj; lia].
  assert (A : named l i (name si)) by now exists si. assert (C : named l j (name sj)) by now exists sj.
  destruct (named_box D E l edges B accepted described bs scale i _ A) as (_ & _ & _ & _ & Pi).
  destruct (named_box D E l edges B accepted described bs scale j _ C) as (_ & _ & _ & _ & Pj).
  destruct (complete i j _ _ A C M P) as [e [Ie Q]].
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

Lemma area_kept : area_holds D E l listed bound = true -> measure_le (possible_region N B) (value bound).
Proof.
  intros H. unfold area_holds in H. rewrite scale in H. destruct (area_onto by_name listed 0) as [z |] eqn:Q; [| discriminate].
  destruct sized as [P U]. apply (at_most_value _ _ _ _ P) in H. apply area_onto_sum in Q.
  assert (V : value (Number (2 * man bound) (expo bound) (den bound)) = 2 * value bound).
  { unfold value. cbn [man expo den]. rewrite mult_IZR. unfold Rdiv. ring. }
  apply (measure_subset _ (possible_region N B) (hull_areas B (map places_of listed)) _); [now intros | |].
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

Lemma diameter2_nonneg b : (0 <= diameter2 b)%Z.
Proof. apply Z.add_nonneg_nonneg; apply Z.square_nonneg. Qed.

Lemma near_is_length e : (0 <= man bound)%Z -> (0 < den bound)%Z -> is_near D E by_name bound e = true ->
  exists d, diameter_le (B (position bs (from e))) d /\ diameter_le (B (position bs (to e))) d /\
  exists h, (forall x y, inside x (B (position bs (from e))) -> inside y (B (position bs (to e))) -> dist x y <= h) /\
    h / 2 + d <= value bound.
Proof.
  intros M P H. unfold is_near in H. destruct (Map.find (from e) by_name) as [a |] eqn:A; [| discriminate].
  destruct (Map.find (to e) by_name) as [b |] eqn:C; [| discriminate]. cbv zeta in H.
  apply box_at_place in A, C. destruct sized as [Q U]. set (k := (expo bound + E)%Z) in *.
  set (h := length2 a b) in *. set (d := Z.max (diameter2 a) (diameter2 b)) in *.
  pose proof (diameter2_nonneg a) as Da. pose proof (diameter2_nonneg b) as Db.
  assert (D0 : (0 <= d)%Z) by (unfold d; lia). assert (H0 : (0 <= h)%Z) by (apply Z.add_nonneg_nonneg; apply Z.square_nonneg).
  apply roots_fit_sound in H; [| exact H0 | exact D0 | |].
  2: { rewrite Z.shiftl_mul_pow2 by lia. apply Z.mul_nonneg_nonneg; [nia | apply Z.pow_nonneg; lia]. }
  2: { rewrite Z.shiftl_mul_pow2 by lia. apply Z.mul_pos_pos; [lia | apply Z.pow_pos_nonneg; lia]. }
  rewrite !shift_value, mult_IZR in H by lia. apply IZR_le in M, D0, H0. apply IZR_lt in P.
  assert (K : powerRZ 2 (Z.max 0 k) = powerRZ 2 k * powerRZ 2 (Z.max 0 (- k))).
  { rewrite <- powerRZ_add by lra. f_equal. lia. }
  pose proof (powerRZ_lt 2 (Z.max 0 (- k)) ltac:(lra)) as T.
  assert (V : IZR (man bound) * IZR D * powerRZ 2 (Z.max 0 k) / (IZR (den bound) * powerRZ 2 (Z.max 0 (- k)))
    = unit D E * value bound).
  { rewrite K. unfold k, unit, value. rewrite powerRZ_add by lra. field. split; apply Rgt_not_eq; assumption. }
  rewrite V in H. set (u := unit D E) in *. pose proof (sqrt_pos (IZR d)) as Rd. pose proof (sqrt_pos (IZR h)) as Rh.
  assert (W : 0 <= sqrt (IZR d) / u) by now apply Rle_mult_inv_pos.
  assert (Sd : u * u * (sqrt (IZR d) / u * (sqrt (IZR d) / u)) = IZR d).
  { transitivity (sqrt (IZR d) * sqrt (IZR d)); [field; lra | now apply sqrt_sqrt]. }
  exists (sqrt (IZR d) / u). split; [| split].
  - apply (diameter_value u a _ _ U A W). rewrite Sd. apply IZR_le. unfold d. lia.
  - apply (diameter_value u b _ _ U C W). rewrite Sd. apply IZR_le. unfold d. lia.
  - exists (sqrt (IZR h) / u). split.
    + intros x y X Y. pose proof (length_value u a b _ _ x y U A C X Y) as L. fold h in L.
      apply (Rmult_le_reg_l u); [exact U |]. replace (u * (sqrt (IZR h) / u)) with (sqrt (IZR h)) by (field; lra).
      apply le_of_squares; [exact Rh |]. rewrite sqrt_sqrt by exact H0. rewrite <- dist_sq in L. lra.
    + apply (Rmult_le_reg_l u); [exact U |].
      replace (u * (sqrt (IZR h) / u / 2 + sqrt (IZR d) / u)) with (sqrt (IZR h) / 2 + sqrt (IZR d)) by (field; lra). exact H.
Qed.

Lemma hausdorff_kept p : hausdorff_holds D E l edges opened bound = true -> choice N B p ->
  (forall z, graph N p z -> possible_region N B z) /\
  (forall z, possible_region N B z -> exists w, graph N p w /\ dist z w <= value bound).
Proof.
  intros H P. unfold hausdorff_holds in H. rewrite scale in H. cbv zeta in H. rewrite !andb_true_iff, !forallb_forall in H.
  destruct H as [[[M Q] H] O]. apply Z.leb_le in M. apply Z.ltb_lt in Q.
  apply triangulation_hausdorff; [exact P |]. intros i j I J N0 W.
  destruct (possible_listed i j I J N0 W) as [e [Ie G]]. rewrite rev_append_rev, in_app_iff, <- in_rev in Ie.
  destruct Ie as [Ie | Ie].
  - destruct (near_is_length e M Q (O e Ie)) as (d & D1 & D2 & h & Hh & F). exists d.
    unfold places_of in G. destruct G as [G | G]; injection G as G1 G2; rewrite G1 in *; rewrite G2 in *.
    + split; [exact D1 |]. split; [exact D2 |]. right. now exists h.
    + split; [exact D2 |]. split; [exact D1 |]. right. exists h. split; [| exact F].
      intros x y X Y. rewrite dist_sym. now apply Hh.
  - exists (value bound). specialize (H e Ie). apply andb_true_iff in H. destruct H as [H1 H2].
    apply (within_is_diameter _ M Q) in H1, H2.
    assert (L : legal N B (position bs (from e)) (position bs (to e))).
    { destruct (accepted_names D E l edges B accepted described e Ie) as [[a A] [b C]].
      destruct (named_box D E l edges B accepted described bs scale a _ A) as (_ & _ & _ & _ & Pa).
      destruct (named_box D E l edges B accepted described bs scale b _ C) as (_ & _ & _ & _ & Pb).
      rewrite Pa, Pb. eexists. exact (accepted_witness D E l edges B accepted described e a b Ie A C). }
    unfold places_of in G. destruct G as [G | G]; injection G as G1 G2; rewrite G1 in *; rewrite G2 in *.
    + split; [exact H1 |]. split; [exact H2 |]. left. split; [exact L | lra].
    + split; [exact H2 |]. split; [exact H1 |]. left. split; [| lra].
      destruct L as [c L]. exists c. now apply witness_sym.
Qed.

End Complete.

(* The bound of the area: the region of all possible pairs measures at most so much. *)
Theorem accepted_area D E l edges opened B bound :
  check D E l edges = true -> describes l B -> lists_all l B (rev_append opened edges) ->
  area_holds D E l (rev_append opened edges) bound = true -> measure_le (possible_region (length l) B) (value bound).
Proof.
  intros C F G H. destruct (accepted_parts D E l edges C) as (bs & S & _).
  exact (area_kept D E l edges opened B C F G bs S bound H).
Qed.

(* The bound of the Hausdorff distance: the true graph of every choice is in that region, which is nowhere farther from it. *)
Theorem accepted_hausdorff D E l edges opened B bound p :
  check D E l edges = true -> describes l B -> lists_all l B (rev_append opened edges) ->
  hausdorff_holds D E l edges opened bound = true -> choice (length l) B p ->
  (forall z, graph (length l) p z -> possible_region (length l) B z) /\
  (forall z, possible_region (length l) B z -> exists w, graph (length l) p w /\ dist z w <= value bound).
Proof.
  intros C F G H P. destruct (accepted_parts D E l edges C) as (bs & S & _).
  exact (hausdorff_kept D E l edges opened B C F G bs S bound p H P).
Qed.
